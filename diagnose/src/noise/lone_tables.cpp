// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/lone_tables.hpp>

#include "data/median.hpp"

#include <coagula/diagnose/noise.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace coagula::diagnose {

namespace {

using Index = Eigen::Index;

constexpr std::size_t fewest_rows = 3;
constexpr double far = 6;  ///< distances between the others

bool is_phase(const Replicates& replicates) {
    return replicates.observable == "phase";
}

/// Logarithms of the values, angles of a phase; a column per table, the rows that all tables have.
Eigen::MatrixXd comparable(const Replicates& replicates) {
    const Eigen::MatrixXd values = is_phase(replicates)
                                       ? Eigen::MatrixXd(replicates.levels.cwiseInverse().asDiagonal() * replicates.values)
                                       : Eigen::MatrixXd(replicates.values.array().log());
    std::vector<Index> rows;
    for (Index row = 0; row < values.rows(); ++row) {
        if (values.row(row).allFinite()) {
            rows.push_back(row);
        }
    }
    return values(rows, Eigen::all);
}

/// Where the others lie: their median, and how far they lie apart.
struct Others {
    double middle = 0;
    double apart = 0;
};

Others others_than(std::size_t table, std::vector<double> levels) {
    levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(table));
    const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
    return {median(levels), *high - *low};
}

/// Probability that one of several samples lies this far off the mean of the others, which differ as they do: samples of one batch
/// differ by a tenth, known to a factor of e. @param others their levels, as logarithms. @param distance from their mean.
double chance_of(const Eigen::ArrayXd& others, double distance) {
    constexpr double usual = 0.1;
    constexpr double farthest = 4;  // logarithms of the scatter
    constexpr int nodes = 81;
    const auto count = static_cast<double>(others.size());
    const double squares = (others - others.mean()).square().sum();
    const Eigen::ArrayXd logarithm = Eigen::ArrayXd::LinSpaced(nodes, -farthest, farthest);
    const Eigen::ArrayXd scatter = usual * logarithm.exp();
    const Eigen::ArrayXd density = -0.5 * logarithm.square() - (count - 1) * scatter.log() - 0.5 * squares / scatter.square();
    const Eigen::ArrayXd weight = (density - density.maxCoeff()).exp();
    const Eigen::ArrayXd beyond =
        (std::abs(distance) / (scatter * std::sqrt(2 * (1 + 1 / count)))).unaryExpr([](double x) { return std::erfc(x); });
    return (count + 1) * (weight * beyond).sum() / weight.sum();
}

/// The sample of three or more that lies apart from the others by more than chance makes it.
std::optional<LoneTable> sample_apart(const Replicates& replicates, const std::vector<double>& levels) {
    constexpr double rare = 0.05;
    constexpr std::size_t fewest_samples = 3;
    std::map<std::string, std::vector<double>> tables;
    for (std::size_t table = 0; table < levels.size(); ++table) {
        tables[replicates.samples[table]].push_back(levels[table]);
    }
    if (is_phase(replicates) || tables.size() < fewest_samples) {
        return std::nullopt;
    }
    std::vector<double> of_samples;
    for (const auto& [sample, own] : tables) {
        of_samples.push_back(std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(own.size()));
    }
    double least = rare;
    std::optional<LoneTable> found;
    auto here = of_samples.begin();
    for (const auto& [sample, own] : tables) {
        std::vector<double> others(of_samples.begin(), here);
        others.insert(others.end(), here + 1, of_samples.end());
        const Eigen::ArrayXd rest = Eigen::ArrayXd::Map(others.data(), static_cast<Index>(others.size()));
        const double distance = *here++ - rest.mean();
        if (const double chance = chance_of(rest, distance); chance < least) {
            least = chance;
            const auto first = std::find(replicates.samples.begin(), replicates.samples.end(), sample) - replicates.samples.begin();
            found = {replicates.labels[static_cast<std::size_t>(first)], sample, replicates.observable, std::exp(distance)};
        }
    }
    return found;
}

std::optional<LoneTable> farthest(const Replicates& replicates) {
    const Eigen::MatrixXd values = comparable(replicates);
    const auto tables = static_cast<std::size_t>(values.cols());
    if (tables < 2 || static_cast<std::size_t>(values.rows()) < fewest_rows) {
        return std::nullopt;
    }
    std::vector<double> levels;
    for (const auto& column : values.colwise()) {
        levels.push_back(median({column.begin(), column.end()}));
    }
    const bool two = tables == 2;
    double least = is_phase(replicates) ? (two ? 0.1 : 0.03) : std::log(two ? 3.0 : 2.0);
    std::optional<LoneTable> found;
    for (std::size_t table = 0; table < tables; ++table) {
        const Others others = others_than(table, levels);
        const double distance = levels[table] - others.middle;
        if (std::abs(distance) > std::max(least, far * others.apart)) {
            least = std::abs(distance);
            found = {replicates.labels[table],
                     replicates.samples[table],
                     replicates.observable,
                     is_phase(replicates) ? distance : std::exp(distance),
                     two,
                     two ? replicates.labels[1 - table] : ""};
        }
    }
    return found ? found : sample_apart(replicates, levels);
}

}  // namespace

std::vector<LoneTable> lone_tables(const std::vector<Measurement>& tables) {
    std::vector<LoneTable> all;
    for (const Replicates& replicates : find_replicates(tables)) {
        if (std::optional<LoneTable> found = farthest(replicates)) {
            all.push_back(std::move(*found));
        }
    }
    return all;
}

}  // namespace coagula::diagnose
