#include "data_set.hpp"

#include "pore_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t fewest_observations = 5;
constexpr std::size_t most_observations = 3000;  ///< covariances of more take many minutes and say little more
constexpr double least_error = 1e-4;             ///< of a number over it: what no instrument reads better

RowNoise noise_of(const std::vector<Observation>& observations, const Eigen::VectorXd& deviation) {
    RowNoise noise{deviation, {}, Eigen::VectorXd::Zero(deviation.size())};
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& one = observations[k];
        const bool follows = k > 0 && same_column(observations[k - 1], one);
        noise.previous.push_back(follows ? static_cast<Index>(k) - 1 : -1);
        if (follows) {
            const auto distance = static_cast<double>(one.row) - static_cast<double>(observations[k - 1].row);
            noise.correlation[static_cast<Index>(k)] = std::pow(one.errors.correlation, std::abs(distance));
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
    Eigen::VectorXd white = values.cwiseQuotient(deviation);
    for (Index row = white.size() - 1; row > 0; --row) {
        const double c = correlation[row];
        if (c > 0) {
            const Index before = previous[static_cast<std::size_t>(row)];
            white[row] = (white[row] - c * white[before]) / std::sqrt(1 - c * c);
        }
    }
    return white;
}

double RowNoise::log_determinant() const {
    return 2 * deviation.array().log().sum() + (1 - correlation.array().square()).log().sum();
}

Eigen::MatrixXd RowNoise::covariance() const {
    Eigen::MatrixXd matrix = deviation.cwiseAbs2().asDiagonal();
    for (Index row = 1; row < deviation.size(); ++row) {
        double product = 1;
        for (Index other = row; previous[static_cast<std::size_t>(other)] >= 0;) {
            product *= correlation[other];
            other = previous[static_cast<std::size_t>(other)];
            matrix(row, other) = matrix(other, row) = product * deviation[row] * deviation[other];
        }
    }
    return matrix;
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
    return some;
}

DataSet data_set_of(const Experiment& experiment, const NoiseSettings& noise) {
    DataSet data;
    data.observations = observations_of(experiment);
    data.effect = noise.sample;
    data.effect_degrees = noise.sample_degrees;
    if (data.observations.size() < fewest_observations) {
        const auto& tables = experiment.measurements;
        const bool centres = std::any_of(tables.begin(), tables.end(),
                                         [](const Measurement& table) { return table.kind == MeasurementKind::coordinates; });
        throw InputError("the experiment has " + std::to_string(data.observations.size()) +
                         " usable numbers: at least five are needed to say anything" +
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
        const double stated = one.loss ? std::hypot(noise.loss_floor, noise.loss_relative * one.value)
                                       : std::hypot(noise.storage_floor, noise.storage_relative * one.value);
        deviation[row] = std::isfinite(one.standard_error) ? one.standard_error : stated;
        if (deviation[row] > 0) {
            deviation[row] = std::max(deviation[row], least_error * std::abs(one.value));
        }
        if (!(deviation[row] > 0)) {
            const Measurement& table = experiment.measurements[one.measurement];
            throw InputError(table.label + ": row " + std::to_string(one.row + 1) + " of " + observable_of(one) +
                             " has no error: state a noise or standard error above zero");
        }
        const std::string& name = experiment.measurements[one.measurement].sample;
        const auto found = std::find(data.sample_names.begin(), data.sample_names.end(), name);
        data.sample.push_back(found - data.sample_names.begin());
        if (found == data.sample_names.end()) {
            data.sample_names.push_back(name);
        }
        if (is_pore(one) || one.difference || one.third_harmonic) {
            data.sample.back() = -1;
        }
    }
    data.noise = noise_of(data.observations, deviation);
    return data;
}

}  // namespace coagula::diagnose
