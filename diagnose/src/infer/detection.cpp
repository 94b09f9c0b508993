// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection.hpp"

#include "data/normal_number.hpp"
#include "fitted_scales.hpp"
#include "steps_towards.hpp"

#include <coagula/common/special_functions.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

constexpr std::size_t fewest_rows = 5;
constexpr int components = 3;  ///< smooth ones: constant and two half waves

/// Whether a coordinate varies over these rows by more than noise.
bool varies(const std::vector<Observation>& observations, const std::vector<Index>& rows, Coordinate coordinate) {
    double low = 1e300;
    double high = -1e300;
    for (const Index row : rows) {
        const double value = coordinate_of(observations[static_cast<std::size_t>(row)], coordinate);
        if (!std::isfinite(value)) {
            return false;
        }
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return high > low * 1.05 + 1e-300;
}

/// Selects the rows whose tables go through the coordinate, where some do: along others it says only what else those tables
/// have in common.
std::vector<Index> swept(const std::vector<Observation>& observations, const std::vector<Index>& rows, Coordinate coordinate) {
    std::map<std::size_t, std::vector<Index>> tables;
    for (const Index row : rows) {
        tables[observations[static_cast<std::size_t>(row)].measurement].push_back(row);
    }
    std::vector<Index> some;
    for (const auto& [number, own] : tables) {
        if (varies(observations, own, coordinate)) {
            some.insert(some.end(), own.begin(), own.end());
        }
    }
    return some.empty() ? rows : some;
}

void sort_along(const std::vector<Observation>& observations, std::vector<Index>& rows, Coordinate coordinate) {
    std::stable_sort(rows.begin(), rows.end(), [&](Index a, Index b) {
        return coordinate_of(observations[static_cast<std::size_t>(a)], coordinate) <
               coordinate_of(observations[static_cast<std::size_t>(b)], coordinate);
    });
}

/// Half waves over so many rows, as unit vectors: rows x components.
Eigen::MatrixXd waves(Index rows) {
    const auto count = static_cast<double>(rows);
    Eigen::MatrixXd all = Eigen::MatrixXd::Constant(rows, components, std::sqrt(1 / count));
    for (Index order = 1; order < components; ++order) {
        all.col(order) = std::sqrt(2 / count) *
                         (pi * static_cast<double>(order) / count * Eigen::ArrayXd::LinSpaced(rows, 0.5, count - 0.5)).cos();
    }
    return all;
}

/// Each observable along each coordinate over all tables.
void add_smooth(const std::vector<Observation>& observations, std::vector<MisfitStatistic>& all) {
    std::vector<const Observable*> shown;  // by each observation
    std::vector<const Observable*> kinds;
    for (const Observation& observation : observations) {
        shown.push_back(&observable_of(observation));
        if (std::find(kinds.begin(), kinds.end(), shown.back()) == kinds.end()) {
            kinds.push_back(shown.back());
        }
    }
    for (const Observable* kind : kinds) {
        for (const Coordinate coordinate : all_coordinates) {
            MisfitStatistic one{.observable = std::string(kind->key), .coordinate = coordinate};
            for (std::size_t row = 0; row < observations.size(); ++row) {
                if (shown[row] == kind && std::isfinite(coordinate_of(observations[row], coordinate))) {
                    one.rows.push_back(static_cast<Index>(row));
                }
            }
            one.rows = swept(observations, one.rows, coordinate);
            if (one.rows.size() >= fewest_rows && varies(observations, one.rows, coordinate)) {
                sort_along(observations, one.rows, coordinate);
                all.push_back(one);
                all.back().directions = waves(static_cast<Index>(one.rows.size()));
                one.autocorrelation = true;
                all.push_back(one);
            }
        }
    }
}

/// All third harmonics.
void add_harmonics(const std::vector<Observation>& observations, std::vector<MisfitStatistic>& all) {
    MisfitStatistic one{.observable = "third_harmonic"};
    for (Index row = 0; row < static_cast<Index>(observations.size()); ++row) {
        if (is<Harmonic>(observations[static_cast<std::size_t>(row)])) {
            one.rows.push_back(row);
        }
    }
    if (!one.rows.empty()) {
        all.push_back(std::move(one));
    }
}

/// Rows by the kind of their table, where there are several kinds.
std::map<MeasurementKind, std::vector<Index>> rows_of_kinds(const Inference& inference) {
    const std::vector<Observation>& observations = inference.errors().data().observations;
    std::map<MeasurementKind, std::vector<Index>> kinds;
    for (std::size_t row = 0; row < observations.size(); ++row) {
        kinds[inference.forward().experiment().measurements[observations[row].measurement].kind].push_back(static_cast<Index>(row));
    }
    return kinds.size() > 1 ? kinds : std::map<MeasurementKind, std::vector<Index>>{};
}

/// A step towards every one of these mechanisms that the fit does not have: in all rows, and in those of each kind of table, for
/// few numbers that fail are lost among many that do not.
void add_causes(const Inference& inference, const Fit& fit, const Prediction& about, const Hypothesis& causes, Index rows,
                const Eigen::MatrixXd& basis, std::vector<MisfitStatistic>& all) {
    const std::map<MeasurementKind, std::vector<Index>> kinds = rows_of_kinds(inference);
    for (const auto& [kind, own] : kinds) {
        all.push_back({.observable = "all", .rows = own, .tables = std::string(name_of(kind))});
    }
    for (const Mechanism* mechanism : causes) {
        if (std::find(fit.hypothesis.begin(), fit.hypothesis.end(), mechanism) != fit.hypothesis.end()) {
            continue;
        }
        MisfitStatistic one{.observable = "all", .cause = mechanism->name};
        const std::vector<Eigen::VectorXd> directions = steps_towards(*mechanism, inference, fit, about, basis);
        if (!directions.empty()) {
            one.directions.resize(rows, static_cast<Index>(directions.size()));
            for (std::size_t k = 0; k < directions.size(); ++k) {
                one.directions.col(static_cast<Index>(k)) = directions[k];
            }
            for (const auto& [kind, own] : kinds) {
                MisfitStatistic part{.observable = "all", .tables = std::string(name_of(kind)), .cause = mechanism->name};
                part.directions = steps_in(own, one.directions, basis);
                if (part.directions.cols() > 0) {
                    all.push_back(std::move(part));
                }
            }
            all.push_back(std::move(one));
        }
    }
}

/// All ways to fail. @param about prediction of the fit. @param basis orthonormal, of what the fitted quantities move.
std::vector<MisfitStatistic> statistics_of(const Inference& inference, const Fit& fit, const Prediction& about,
                                           const Hypothesis& causes, Index rows, const Eigen::MatrixXd& basis) {
    const DataSet& data = inference.errors().data();
    const auto between = [](Index from, Index to) {
        std::vector<Index> range(static_cast<std::size_t>(to - from));
        std::iota(range.begin(), range.end(), from);
        return range;
    };
    const Index samples = data.effect > 0 ? data.samples() : 0;
    std::vector<MisfitStatistic> all{{.observable = "all", .rows = between(0, rows)}};
    if (samples > 1) {
        all.push_back({.observable = "sample_effect", .rows = between(data.size(), data.size() + samples)});
    }
    if (std::isfinite(inference.stiffness_departure(0))) {
        all.push_back({.observable = "normal_stiffness", .rows = {rows - 1}});
    }
    add_harmonics(data.observations, all);
    add_smooth(data.observations, all);
    add_causes(inference, fit, about, causes, rows, basis, all);
    return all;
}

/// Tells whether the statistic is the sum of the squares of whole groups. Over scales that these tell themselves it would say
/// nothing.
bool is_of_whole_groups(const MisfitStatistic& statistic) {
    return statistic.cause.empty() && statistic.coordinate == Coordinate::none;
}

/// Value of the statistic for each column of residuals.
Eigen::RowVectorXd evaluate(const MisfitStatistic& statistic, const Eigen::MatrixXd& residuals) {
    if (!statistic.cause.empty()) {
        return (statistic.directions.transpose() * residuals).colwise().maxCoeff().array().max(0).square();
    }
    const Eigen::MatrixXd own = residuals(statistic.rows, Eigen::all);
    if (is_of_whole_groups(statistic)) {
        return own.colwise().squaredNorm();
    }
    if (statistic.autocorrelation) {
        const Index pairs = own.rows() - 1;
        return own.topRows(pairs).cwiseProduct(own.bottomRows(pairs)).colwise().sum() / std::sqrt(static_cast<double>(own.rows()));
    }
    return (statistic.directions.transpose() * own).colwise().squaredNorm();
}

/// The residuals of data that are drawn, and last those of the measured ones, without what the fitted quantities move.
/// @param about prediction of the fit. @param basis orthonormal, of what these move.
Eigen::MatrixXd drawn_residuals(const Inference& inference, const Departures& departures, const Prediction& about,
                                const Eigen::MatrixXd& basis, std::uint64_t seed, int bootstrap, const Progress& progress) {
    constexpr int looks = 100;  // data sets between two looks at the progress callback
    const Index rows = departures.residual.size();
    const Index last_error = std::isfinite(inference.stiffness_departure(0)) ? rows - 1 : rows;
    Eigen::MatrixXd drawn(rows, bootstrap + 1);
    drawn.col(bootstrap) = departures.residual;
    for (int sample = 0; sample < bootstrap; ++sample) {
        if (sample % looks == 0) {
            progress.update("drawing data sets", static_cast<double>(sample) / bootstrap);
        }
        const Eigen::VectorXd errors = inference.errors().draw(seed, static_cast<std::uint64_t>(sample));
        drawn.col(sample).head(errors.size()) = errors;
        const auto normal = [&](Index row) {
            return normal_number(seed, static_cast<std::uint64_t>(sample), static_cast<std::uint64_t>(1000000 + rows - 1 - row));
        };
        const double scale =
            std::isfinite(about.errors.degrees) ? 1 / std::sqrt(scaled_chi_square(about.errors.degrees, normal(rows))) : 1.0;
        for (Index row = errors.size(); row < rows; ++row) {
            drawn(row, sample) = (row < last_error ? scale : 1.0) * normal(row);
        }
    }
    drawn -= basis * (basis.transpose() * drawn);
    return drawn;
}

/// z-score by rank. The largest tenth follows an exponential tail of the same mean, so that values beyond all others differ.
Eigen::ArrayXd standardised(const Eigen::ArrayXd& values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const auto count = static_cast<double>(sorted.size());
    const double threshold = sorted[sorted.size() - 1 - sorted.size() / 10];
    const auto tail = std::upper_bound(sorted.begin(), sorted.end(), threshold);
    const auto beyond = static_cast<double>(sorted.end() - tail);
    const double excess = std::accumulate(tail, sorted.end(), 0.0) / std::max(beyond, 1.0) - threshold;
    return values.unaryExpr([&](double value) {
        const auto larger = static_cast<double>(sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value));
        const double probability =
            value > threshold ? beyond / count * std::exp(std::max(-(value - threshold) / excess, -650.0)) : (larger - 0.5) / count;
        return upper_normal_quantile(probability);
    });
}

}  // namespace

Detection detect(const Inference& inference, const Fit& fit, const Hypothesis& causes, std::uint64_t seed, int bootstrap,
                 const Progress& progress) {
    const Departures departures = departures_of(inference, fit);
    const Eigen::MatrixXd basis = orthonormal_basis(departures.jacobian);
    const Prediction about = inference.prediction(fit.model);
    const Eigen::MatrixXd residuals = drawn_residuals(inference, departures, about, basis, seed, bootstrap, progress);
    const Eigen::MatrixXd scaled = over_fitted_scales(residuals, basis, scaled_rows(inference.errors()));
    Detection result;
    result.statistics = statistics_of(inference, fit, about, causes, residuals.rows(), basis);
    const auto kinds = static_cast<Index>(result.statistics.size());
    Eigen::MatrixXd values(kinds, bootstrap + 1);
    for (Index kind = 0; kind < kinds; ++kind) {
        progress.update("testing the fit", static_cast<double>(kind) / static_cast<double>(kinds));
        MisfitStatistic& statistic = result.statistics[static_cast<std::size_t>(kind)];
        const Eigen::RowVectorXd own = evaluate(statistic, is_of_whole_groups(statistic) ? residuals : scaled);
        statistic.value = own[bootstrap];
        // With the data among the samples, so that all are on the same footing.
        values.row(kind) = standardised(own.transpose().array()).transpose();
        statistic.score = values(kind, bootstrap);
    }
    const Eigen::RowVectorXd largest = values.colwise().maxCoeff();
    const double observed = largest[bootstrap];
    result.bootstrap.assign(largest.begin(), largest.end() - 1);
    result.p_value = static_cast<double>((largest.array() >= observed).count()) / (bootstrap + 1);
    std::stable_sort(result.statistics.begin(), result.statistics.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    return result;
}

}  // namespace coagula::diagnose
