#include "detection.hpp"

#include "weights.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

void sort_along(const std::vector<Observation>& observations, std::vector<Index>& rows, Coordinate coordinate) {
    std::stable_sort(rows.begin(), rows.end(), [&](Index a, Index b) {
        return coordinate_of(observations[static_cast<std::size_t>(a)], coordinate) <
               coordinate_of(observations[static_cast<std::size_t>(b)], coordinate);
    });
}

/// All ways to fail: everything, each observable along each coordinate over all tables.
std::vector<MisfitStatistic> statistics_of(const std::vector<Observation>& observations) {
    std::vector<MisfitStatistic> all;
    MisfitStatistic whole{.observable = "all"};
    for (Index row = 0; row < static_cast<Index>(observations.size()); ++row) {
        whole.rows.push_back(row);
    }
    all.push_back(whole);
    for (const bool loss : {false, true}) {
        for (const Coordinate coordinate : {Coordinate::strain, Coordinate::angular_frequency, Coordinate::time, Coordinate::gap}) {
            MisfitStatistic one{.observable = loss ? "loss_modulus" : "storage_modulus", .coordinate = coordinate};
            for (Index row = 0; row < static_cast<Index>(observations.size()); ++row) {
                const Observation& observation = observations[static_cast<std::size_t>(row)];
                if (observation.loss == loss && std::isfinite(coordinate_of(observation, coordinate))) {
                    one.rows.push_back(row);
                }
            }
            if (one.rows.size() >= fewest_rows && varies(observations, one.rows, coordinate)) {
                sort_along(observations, one.rows, coordinate);
                all.push_back(one);
                one.autocorrelation = true;
                all.push_back(one);
            }
        }
    }
    return all;
}

double evaluate(const MisfitStatistic& statistic, const Eigen::VectorXd& residual) {
    if (statistic.coordinate == Coordinate::none) {
        return residual.squaredNorm();
    }
    const auto count = static_cast<double>(statistic.rows.size());
    double value = 0;
    if (statistic.autocorrelation) {
        for (std::size_t k = 1; k < statistic.rows.size(); ++k) {
            value += residual[statistic.rows[k]] * residual[statistic.rows[k - 1]];
        }
        return value / std::sqrt(count);
    }
    for (int order = 0; order < components; ++order) {
        double sum = 0;
        for (std::size_t k = 0; k < statistic.rows.size(); ++k) {
            const double wave = std::cos(pi * order * (static_cast<double>(k) + 0.5) / count);
            sum += (order == 0 ? 1 : std::numbers::sqrt2) * wave * residual[statistic.rows[k]];
        }
        value += sum * sum / count;
    }
    return value;
}

/// Independent standard normal numbers.
Eigen::VectorXd normal_numbers(Index count, std::uint64_t seed, std::uint64_t sample) {
    Eigen::VectorXd values(count);
    for (Index k = 0; k < count; ++k) {
        values[k] = normal_number(seed, sample, static_cast<std::uint64_t>(k));
    }
    return values;
}

}  // namespace

const char* name_of(Coordinate coordinate) {
    constexpr std::array<const char*, 5> names{"strain", "angular_frequency", "time", "gap", "none"};
    return names.at(static_cast<std::size_t>(coordinate));
}

double coordinate_of(const Observation& observation, Coordinate coordinate) {
    switch (coordinate) {
        case Coordinate::strain:
            return observation.strain;
        case Coordinate::angular_frequency:
            return observation.angular_frequency;
        case Coordinate::time:
            return observation.time;
        case Coordinate::gap:
            return observation.gap;
        default:
            return 0;
    }
}

Detection detect(const std::vector<Observation>& observations, const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                 std::uint64_t seed, int bootstrap) {
    Detection result;
    result.statistics = statistics_of(observations);
    const auto kinds = static_cast<Index>(result.statistics.size());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(jacobian);
    Eigen::MatrixXd values(kinds, bootstrap + 1);  // the data themselves come last
    for (int sample = 0; sample <= bootstrap; ++sample) {
        Eigen::VectorXd drawn = residual;
        if (sample < bootstrap) {
            drawn = normal_numbers(residual.size(), seed, static_cast<std::uint64_t>(sample));
            drawn -= jacobian * decomposition.solve(drawn);
        }
        for (Index kind = 0; kind < kinds; ++kind) {
            values(kind, sample) = evaluate(result.statistics[static_cast<std::size_t>(kind)], drawn);
        }
    }
    // Standardised with the data among the samples, so that all are on the same footing; the logarithm tames the long tails.
    for (Index kind = 0; kind < kinds; ++kind) {
        Eigen::ArrayXd row = values.row(kind).array();
        const double offset = row.minCoeff() - 1;
        row = (row - offset).log();
        const double mean = row.mean();
        const double deviation = std::max(std::sqrt((row - mean).square().mean()), 1e-12);
        values.row(kind) = ((row - mean) / deviation).matrix();
    }
    const Eigen::RowVectorXd largest = values.colwise().maxCoeff();
    const double observed = largest[bootstrap];
    result.bootstrap.assign(largest.begin(), largest.end() - 1);
    result.p_value = static_cast<double>((largest.array() >= observed).count()) / (bootstrap + 1);
    for (Index kind = 0; kind < kinds; ++kind) {
        MisfitStatistic& statistic = result.statistics[static_cast<std::size_t>(kind)];
        statistic.value = evaluate(statistic, residual);
        statistic.score = values(kind, bootstrap);
    }
    std::stable_sort(result.statistics.begin(), result.statistics.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    return result;
}

}  // namespace coagula::diagnose
