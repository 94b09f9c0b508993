// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/replicate_groups.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/noise.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

namespace coagula::diagnose {

namespace {

using Index = Eigen::Index;

constexpr Index fewest_replicates = 3;
constexpr Index fewest_common_rows = 5;
constexpr double decisive_deviate = 3.9;  ///< of a normal deviate: one in 20 000
constexpr double least_difference = 0.02;

/// A name for every table; tables of one name make a group.
struct Partition {
    GroupedBy by;
    std::vector<std::string> names;
};

/// Whether there are groups, and a group of several.
bool can_tell(const std::vector<std::string>& names) {
    const std::set<std::string> groups(names.begin(), names.end());
    return groups.size() > 1 && groups.size() < names.size() &&
           std::none_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); });
}

std::vector<Partition> partitions_of(const Replicates& replicates, const std::vector<Measurement>& tables) {
    constexpr double day = 86400;
    Partition by_instrument{GroupedBy::instrument, {}};
    Partition by_day{GroupedBy::day, {}};
    for (const std::size_t place : replicates.tables) {
        const double start = tables[place].start;
        by_instrument.names.push_back(tables[place].instrument);
        by_day.names.push_back(std::isfinite(start) ? std::to_string(static_cast<std::int64_t>(std::floor(start / day))) : "");
    }
    std::vector<Partition> all{by_instrument, by_day, {GroupedBy::sample, replicates.samples}};
    for (const std::string& sample : std::set<std::string>(replicates.samples.begin(), replicates.samples.end())) {
        Partition single{GroupedBy::single_sample, {}};
        for (const std::string& other : replicates.samples) {
            single.names.push_back(other == sample ? sample : "the others");
        }
        all.push_back(std::move(single));
    }
    std::erase_if(all, [](const Partition& one) { return !can_tell(one.names); });
    return all;
}

/// Logarithms in the rows that all tables have, a column per table.
Eigen::MatrixXd logarithms_of(const Replicates& replicates) {
    std::vector<Index> rows;
    for (Index row = 0; row < replicates.values.rows(); ++row) {
        if ((replicates.values.row(row).array() > 0).all()) {
            rows.push_back(row);
        }
    }
    return replicates.values(rows, Eigen::all).array().log();
}

/// Mean squares of differences of tables, their levels aside, and how many independent numbers these are.
struct MeanSquares {
    double within = 0;
    double between = 0;
    double following = 0;  ///< products of neighbouring rows within groups over their squares
    double groups = 0;
};

MeanSquares mean_squares(const Eigen::MatrixXd& logarithms, const Partition& partition) {
    MeanSquares found;
    double pairs_within = 0;
    double pairs_between = 0;
    double products = 0;
    double squares = 0;
    for (Index one = 0; one < logarithms.cols(); ++one) {
        for (Index other = 0; other < one; ++other) {
            Eigen::VectorXd difference = logarithms.col(one) - logarithms.col(other);
            difference.array() -= difference.mean();
            const double square = difference.squaredNorm() / static_cast<double>(difference.size() - 1);
            const bool same = partition.names[static_cast<std::size_t>(one)] == partition.names[static_cast<std::size_t>(other)];
            (same ? found.within : found.between) += square;
            (same ? pairs_within : pairs_between) += 1;
            if (same) {
                const Index steps = difference.size() - 1;
                products += difference.head(steps).dot(difference.tail(steps));
                squares += difference.squaredNorm();
            }
        }
    }
    found.within /= pairs_within;
    found.between /= pairs_between;
    found.following = squares > 0 ? std::clamp(products / squares, 0.0, 0.95) : 0.0;
    found.groups = static_cast<double>(std::set<std::string>(partition.names.begin(), partition.names.end()).size());
    return found;
}

/// A ratio of variances as a normal deviate (Wilson and Hilferty, Proc. Natl. Acad. Sci. 17 (1931) 684).
double deviate_of(double ratio, double degrees, double other_degrees) {
    const double root = std::cbrt(ratio);
    const double one = 2 / (9 * degrees);
    const double other = 2 / (9 * other_degrees);
    return ((1 - other) * root - (1 - one)) / std::sqrt(other * root * root + one);
}

}  // namespace

std::vector<ReplicateGroups> groups_of_replicates(const std::vector<Measurement>& tables) {
    std::vector<ReplicateGroups> all;
    for (const Replicates& replicates : find_replicates(tables)) {
        const Eigen::MatrixXd logarithms = logarithms_of(replicates);
        if (replicates.observable == "phase" || logarithms.cols() < fewest_replicates || logarithms.rows() < fewest_common_rows) {
            continue;
        }
        double largest = decisive_deviate;
        std::optional<ReplicateGroups> best;
        for (const Partition& partition : partitions_of(replicates, tables)) {
            const MeanSquares squares = mean_squares(logarithms, partition);
            const double independent =
                static_cast<double>(logarithms.rows() - 1) * (1 - squares.following) / (1 + squares.following);
            const double floor = 1e-12;  // tables that agree to the last digit
            const double deviate = deviate_of(squares.between / (squares.within + floor), independent * (squares.groups - 1),
                                              independent * (static_cast<double>(logarithms.cols()) - squares.groups));
            if (deviate > largest && std::sqrt(squares.between) > least_difference) {
                largest = deviate;
                std::set<std::string> names(partition.names.begin(), partition.names.end());
                names.erase(partition.by == GroupedBy::single_sample ? "the others" : "");
                best = {partition.by,
                        {names.begin(), names.end()},
                        std::sqrt(squares.between),
                        std::sqrt(squares.within),
                        std::string(name_of(replicates.kind))};
            }
        }
        if (best) {
            all.push_back(std::move(*best));
        }
    }
    return all;
}

}  // namespace coagula::diagnose
