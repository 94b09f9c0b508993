// SPDX-License-Identifier: GPL-3.0-or-later
#include "data_set.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t fewest_observations = 5;
constexpr std::size_t most_observations = 3000;  ///< covariances of more take many minutes and say little more
constexpr double usual_storage_error = 0.03;     ///< of a number over it, where its table has no error
constexpr double usual_loss_error = 0.05;
constexpr double least_error = 1e-4;  ///< of a number over it: what no instrument reads better

/// Returns for each number the one of the same row that its error is turned towards, -1 if there is none.
std::vector<Index> partners_of(const std::vector<Observation>& observations) {
    std::map<std::pair<std::size_t, std::size_t>, Index> storage;
    std::vector<Index> partners(observations.size(), -1);
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& one = observations[k];
        if (const auto* modulus = as<Modulus>(one); modulus == nullptr || modulus->other_error == 0) {
            continue;
        }
        const auto [found, first] = storage.try_emplace({one.measurement, one.row}, static_cast<Index>(k));
        if (!first) {
            partners[k] = found->second;
            partners[static_cast<std::size_t>(found->second)] = static_cast<Index>(k);
        }
    }
    return partners;
}

/// @param deviation of each number's own error, or of the number itself where it has no partner.
RowNoise noise_of(const std::vector<Observation>& observations, const Eigen::VectorXd& deviation) {
    const Index size = deviation.size();
    RowNoise noise{deviation,
                   std::vector<Index>(observations.size(), -1),
                   Eigen::VectorXd::Zero(size),
                   partners_of(observations),
                   Eigen::VectorXd::Ones(size),
                   Eigen::VectorXd::Zero(size)};
    std::map<std::tuple<std::size_t, bool, bool>, std::map<std::size_t, Index>> chains;  // errors of one kind by row
    for (Index k = 0; k < size; ++k) {
        const Observation& one = observations[static_cast<std::size_t>(k)];
        chains[{one.measurement, has_error_of_phase(one), is<Harmonic>(one)}].emplace(one.row, k);
        if (noise.partner[static_cast<std::size_t>(k)] >= 0) {
            const double turned = std::get<Modulus>(one.what).turned;
            noise.cosine[k] = std::cos(turned);
            noise.sine[k] = std::sin(turned);
        }
    }
    const auto axis = [&](Index k) {  // of an error in the plane of G' and G''
        return is_loss(observations[static_cast<std::size_t>(k)]) ? Eigen::Vector2d(-noise.sine[k], noise.cosine[k])
                                                                  : Eigen::Vector2d(noise.cosine[k], noise.sine[k]);
    };
    for (const auto& [kind, chain] : chains) {
        for (auto before = chain.begin(), here = std::next(before); here != chain.end(); ++before, ++here) {
            const double correlation = observations[static_cast<std::size_t>(here->second)].errors.correlation;
            noise.previous[static_cast<std::size_t>(here->second)] = before->second;
            noise.correlation[here->second] = std::copysign(std::pow(correlation, static_cast<double>(here->first - before->first)),
                                                            axis(here->second).dot(axis(before->second)));
        }
    }
    return noise;
}

}  // namespace

double scaled_chi_square(double degrees, double normal) {
    const double part = 2 / (9 * degrees);
    return std::pow(std::max(1e-2, 1 - part + normal * std::sqrt(part)), 3);
}

Eigen::VectorXd RowNoise::whiten(const Eigen::VectorXd& values) const {
    Eigen::VectorXd units = values;
    for (Index storage = 0; storage < static_cast<Index>(partner.size()); ++storage) {
        if (const Index loss = partner[static_cast<std::size_t>(storage)]; loss > storage) {
            units[storage] = cosine[storage] * values[storage] + sine[storage] * values[loss];
            units[loss] = cosine[storage] * values[loss] - sine[storage] * values[storage];
        }
    }
    units = units.cwiseQuotient(deviation);
    Eigen::VectorXd white = units;
    for (Index row = 0; row < units.size(); ++row) {
        if (const double c = correlation[row]; c != 0) {
            white[row] = (units[row] - c * units[previous[static_cast<std::size_t>(row)]]) / std::sqrt(1 - c * c);
        }
    }
    return white;
}

Eigen::MatrixXd RowNoise::whitened(Eigen::MatrixXd columns) const {
    for (auto&& column : columns.colwise()) {
        column = whiten(column);
    }
    return columns;
}

Eigen::VectorXd RowNoise::coloured(const Eigen::VectorXd& white) const {
    Eigen::VectorXd values = white;
    std::vector<Index> next(previous.size(), -1);
    for (std::size_t row = 0; row < previous.size(); ++row) {
        if (previous[row] >= 0) {
            next[static_cast<std::size_t>(previous[row])] = static_cast<Index>(row);
        }
    }
    for (std::size_t first = 0; first < previous.size(); ++first) {
        auto before = static_cast<Index>(first);
        while (previous[first] < 0 && next[static_cast<std::size_t>(before)] >= 0) {
            const Index row = next[static_cast<std::size_t>(before)];
            values[row] = correlation[row] * values[before] + std::sqrt(1 - correlation[row] * correlation[row]) * white[row];
            before = row;
        }
    }
    values = values.cwiseProduct(deviation);
    for (Index storage = 0; storage < static_cast<Index>(partner.size()); ++storage) {
        if (const Index loss = partner[static_cast<std::size_t>(storage)]; loss > storage) {
            const double along = values[storage];
            values[storage] = cosine[storage] * along - sine[storage] * values[loss];
            values[loss] = sine[storage] * along + cosine[storage] * values[loss];
        }
    }
    return values;
}

Eigen::VectorXd RowNoise::marginal_deviation() const {
    Eigen::VectorXd all = deviation;
    for (Index row = 0; row < static_cast<Index>(partner.size()); ++row) {
        if (const Index other = partner[static_cast<std::size_t>(row)]; other >= 0) {
            all[row] = std::hypot(deviation[row] * cosine[row], deviation[other] * sine[row]);
        }
    }
    return all;
}

void RowNoise::widen(const Eigen::VectorXd& further) {
    deviation = (deviation.array().square() + further.array().square()).sqrt();
}

double RowNoise::log_determinant() const {
    return 2 * deviation.array().log().sum() + (1 - correlation.array().square()).log().sum();
}

DataSet DataSet::part(const std::vector<Index>& rows) const {
    DataSet some;
    some.values = values(rows);
    some.sample_names = sample_names;
    some.effect = effect;
    some.effect_degrees = effect_degrees;
    for (const Index row : rows) {
        some.observations.push_back(observations[static_cast<std::size_t>(row)]);
        some.sample.push_back(sample[static_cast<std::size_t>(row)]);
    }
    some.noise = noise_of(some.observations, noise.deviation(rows));
    const Eigen::VectorXd marginal = noise.marginal_deviation();
    for (Index row = 0; row < some.size(); ++row) {
        if (some.noise.partner[static_cast<std::size_t>(row)] < 0) {
            some.noise.deviation[row] = marginal[rows[static_cast<std::size_t>(row)]];
        }
    }
    return some;
}

DataSet data_set_of(const Experiment& experiment, const ErrorSpec& errors) {
    DataSet data;
    data.observations = observations_of(experiment, errors);
    data.effect = errors.sample;
    data.effect_degrees = errors.sample_degrees;
    if (data.observations.size() < fewest_observations) {
        const auto& tables = experiment.measurements;
        const bool centres = std::any_of(tables.begin(), tables.end(),
                                         [](const Measurement& table) { return table.kind == MeasurementKind::coordinates; });
        throw InputError("the experiment has " + std::to_string(data.observations.size()) +
                         " usable numbers, but a diagnosis needs at least five" +
                         (centres
                              ? "; coordinates take part where sample.particle_radius is stated and 20 particles lie deep enough"
                                " inside"
                              : ""));
    }
    if (data.observations.size() > most_observations) {
        throw InputError("the experiment has " + std::to_string(data.observations.size()) + " numbers, more than " +
                         std::to_string(most_observations) +
                         ": take every k-th row of the longest tables, rows = [first, last, k]");
    }
    data.values.resize(static_cast<Index>(data.observations.size()));
    Eigen::VectorXd deviation(data.values.size());
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        const Observation& one = data.observations[k];
        const auto row = static_cast<Index>(k);
        data.values[row] = one.value;
        const double usual = (is_loss(one) ? usual_loss_error : usual_storage_error) * std::abs(one.value);
        deviation[row] = std::isfinite(one.standard_error) ? one.standard_error : usual;
        if (deviation[row] > 0) {
            deviation[row] = std::max(deviation[row], least_error * std::abs(one.value));
        }
        if (!(deviation[row] > 0)) {
            const Measurement& table = experiment.measurements[one.measurement];
            throw InputError(table.label + ": row " + std::to_string(one.row + 1) + " of " + std::string(observable_of(one).key) +
                             " has no error: state a noise or standard error above zero");
        }
        const std::string& name = experiment.measurements[one.measurement].sample;
        const auto found = std::find(data.sample_names.begin(), data.sample_names.end(), name);
        data.sample.push_back(found - data.sample_names.begin());
        if (found == data.sample_names.end()) {
            data.sample_names.push_back(name);
        }
        if (is<Pore>(one) || is<ImageDifference>(one) || is<Harmonic>(one)) {
            data.sample.back() = -1;
        }
    }
    data.noise = noise_of(data.observations, deviation);
    for (Index row = 0; row < data.size(); ++row) {
        const auto* modulus = as<Modulus>(data.observations[static_cast<std::size_t>(row)]);
        if (data.noise.partner[static_cast<std::size_t>(row)] < 0 && modulus != nullptr && modulus->other_error > 0) {
            data.noise.deviation[row] =
                std::hypot(std::cos(modulus->turned) * deviation[row], std::sin(modulus->turned) * modulus->other_error);
        }
    }
    return data;
}

}  // namespace coagula::diagnose
