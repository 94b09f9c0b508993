// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/lone_tables.hpp>

#include "data/median.hpp"

#include <coagula/diagnose/noise.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
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
    return found;
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
