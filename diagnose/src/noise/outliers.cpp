// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/outliers.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/run_clock.hpp>

#include "data/median.hpp"
#include "data/table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace coagula::diagnose {

namespace {

constexpr double row_deviations = 8;
constexpr double least_departure = 0.2;  ///< of a row, logarithmic
constexpr double sample_deviations = 6;
constexpr double usual_scatter = 0.1;  ///< of samples
constexpr Eigen::Index fewest_tables = 3;

/// Logarithm of |G*|, or of |G'| alone; NaN where it is not known.
double log_size(const Measurement& table, std::size_t row) {
    const double both = complex_modulus(table, row);
    const double size = std::isnan(both) ? std::abs(cell(table, "storage_modulus", row)) : both;
    return size > 0 ? std::log(size) : unset;
}

double median_of(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.empty() ? unset : median(std::move(values));
}

/// Deviation of normal numbers of which a half may be anything: from the size that a quarter of them do not reach.
double robust_deviation(std::vector<double> values) {
    constexpr double quarter = 0.3186;  // of normal numbers
    for (double& value : values) {
        value = std::abs(value);
    }
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
    std::nth_element(values.begin(), place, values.end());
    return values.empty() ? unset : *place / quarter;
}

/// Tables that were measured alike: by row of the first one, logarithms of the sizes, tables as columns.
struct AlikeTables {
    std::vector<std::size_t> tables;
    std::vector<double> axis;
    Eigen::MatrixXd sizes;  ///< conditions x tables
};

std::vector<AlikeTables> groups_of(const std::vector<Measurement>& tables) {
    std::vector<AlikeTables> groups;
    for (const Replicates& replicates : find_replicates(tables)) {
        const bool of_torque = replicates.observable == "storage_modulus" || replicates.observable == "complex_modulus";
        if (!of_torque || replicates.values.cols() < fewest_tables) {
            continue;
        }
        AlikeTables group{replicates.tables, {replicates.axis.begin(), replicates.axis.end()}, {}};
        group.sizes.setConstant(replicates.axis.size(), replicates.values.cols(), unset);
        for (Eigen::Index column = 0; column < replicates.values.cols(); ++column) {
            const Measurement& table = tables[replicates.tables[static_cast<std::size_t>(column)]];
            const std::vector<double>& axis = axis_of(table)->values;
            for (std::size_t row = 0; row < axis.size(); ++row) {
                const auto same =
                    std::find_if(group.axis.begin(), group.axis.end(), [&](double one) { return alike(one, axis[row]); });
                if (same != group.axis.end()) {
                    group.sizes(same - group.axis.begin(), column) = log_size(table, row);
                }
            }
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

/// What the other tables of its group say about the logarithm of a size, shifted to the level of its own table; NaN where there are
/// too few.
double by_the_others(const AlikeTables& group, std::size_t table, double place) {
    const auto found = std::find(group.tables.begin(), group.tables.end(), table);
    const auto same = std::find_if(group.axis.begin(), group.axis.end(), [&](double one) { return alike(one, place); });
    if (found == group.tables.end() || same == group.axis.end()) {
        return unset;
    }
    const Eigen::Index own = found - group.tables.begin();
    std::vector<double> shifts;
    double here = unset;
    for (Eigen::Index row = 0; row < group.sizes.rows(); ++row) {
        std::vector<double> others;
        for (Eigen::Index column = 0; column < group.sizes.cols(); ++column) {
            if (column != own) {
                others.push_back(group.sizes(row, column));
            }
        }
        const double middle = median_of(std::move(others));
        shifts.push_back(group.sizes(row, own) - middle);
        here = row == same - group.axis.begin() ? middle : here;
    }
    return here + median_of(std::move(shifts));
}

/// How far a row lies beside both of its neighbours, to the same side and farther than these from each other: 0 on a slope or a
/// step.
double beside_neighbours(const std::vector<double>& sizes, std::size_t row) {
    const double before = sizes[row] - sizes[row - 1];
    const double after = sizes[row] - sizes[row + 1];
    const double departure = std::copysign(std::min(std::abs(before), std::abs(after)), before);
    const bool alone = before * after > 0 && std::abs(sizes[row - 1] - sizes[row + 1]) < std::abs(departure);
    return alone ? departure : 0.0;
}

void leave_out(Measurement& table, std::size_t row, const std::string& reason) {
    for (Column& column : table.columns) {
        const bool modulus = column.name == "storage_modulus" || column.name == "loss_modulus";
        if (modulus && std::isfinite(column.values[row])) {
            table.left_out.push_back({column.name, row, to_text(column.values[row]), reason});
            column.values[row] = unset;
        }
    }
}

std::string times_text(double departure) {
    const double factor = std::exp(std::abs(departure));
    return to_text(std::round(10 * factor) / 10) + (departure > 0 ? " times as large as" : " times as small as");
}

/// The sizes of a table that are known, with their rows.
struct Sizes {
    explicit Sizes(const Measurement& table) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (const double size = log_size(table, row); std::isfinite(size)) {
                values.push_back(size);
                rows.push_back(row);
                negative.push_back(cell(table, "storage_modulus", row) < 0);
            }
        }
    }

    /// Deviation of a single size about the middle of its neighbours; NaN where there are too few.
    double deviation() const {
        std::vector<double> bends;
        for (std::size_t k = 1; k + 1 < values.size(); ++k) {
            bends.push_back(values[k] - 0.5 * (values[k - 1] + values[k + 1]));
        }
        return bends.size() < 3 ? unset : robust_deviation(std::move(bends)) / std::sqrt(1.5);
    }

    /// How far one lies beside its neighbours; at an end, where there is one, beside that.
    double departure(std::size_t k) const {
        if (k == 0 || k + 1 == values.size()) {
            return values[k] - values[k == 0 ? 1 : k - 1];
        }
        const double beside = beside_neighbours(values, k);
        return beside < 0 && negative[k - 1] != negative[k + 1] ? 0.0 : beside;  // raw |G*| is least where inertia cancels G'
    }

    /// Whether one at an end is far above its neighbour, and its next ones by far less from each other, so that no course of theirs
    /// leads to it. A sample that still builds up may be below.
    bool stands_apart(std::size_t end) const {
        constexpr double least = 1.1;  // a factor of three
        constexpr double share = 0.25;
        constexpr std::size_t looked_at = 5;
        if (values.size() <= looked_at) {
            return false;
        }
        const auto from_end = [&](std::size_t k) { return values[end == 0 ? k : end - k]; };
        const double apart = from_end(0) - from_end(1);
        double largest = 0;
        for (std::size_t k = 1; k < looked_at; ++k) {
            largest = std::max(largest, std::abs(from_end(k) - from_end(k + 1)));
        }
        return apart > least && largest < share * apart;
    }

    std::vector<double> values;
    std::vector<std::size_t> rows;
    std::vector<bool> negative;  ///< G'
};

/// @param usual deviation of the sizes of a table.
void leave_out_rows(std::vector<Measurement>& tables, std::size_t number, const std::vector<AlikeTables>& groups, double usual,
                    std::vector<Outlier>& found) {
    Measurement& table = tables[number];
    const Sizes sizes(table);
    const double own = sizes.deviation();
    const double deviation = std::isnan(own) ? usual : std::min(own, 3 * usual);
    const std::size_t first = table.rows() == 0 ? 0 : rows_in_time(table).front();
    for (std::size_t k = 0; k < sizes.values.size() && sizes.values.size() > 2 && std::isfinite(deviation); ++k) {
        const bool end = k == 0 || k + 1 == sizes.values.size();
        const double departure = sizes.departure(k);
        const double place = axis_of(table)->values[sizes.rows[k]];
        // The others contradict, or there are none, which tells nothing of an end, but for the first row that was measured: before
        // it the sample had no time to change.
        bool contradicted = !end || (sizes.rows[k] == first && sizes.stands_apart(k));
        for (const AlikeTables& group : groups) {
            const double expected = by_the_others(group, number, place);
            contradicted = std::isnan(expected) ? contradicted : std::abs(sizes.values[k] - expected) > 0.5 * std::abs(departure);
        }
        if (std::abs(departure) > std::max(row_deviations * deviation, least_departure) && contradicted) {
            found.push_back({number, sizes.rows[k], std::exp(departure), times_text(departure)});
            leave_out(table, sizes.rows[k], "outlier: |G*| is " + found.back().size + " in the rows beside it");
        }
    }
}

/// Median logarithmic distance of every sample of a group from the others.
std::map<std::string, double> levels_in(const AlikeTables& group, const std::vector<Measurement>& tables) {
    std::map<std::string, std::vector<double>> all;
    for (Eigen::Index row = 0; row < group.sizes.rows(); ++row) {
        const double middle = median_of({group.sizes.row(row).begin(), group.sizes.row(row).end()});
        for (Eigen::Index column = 0; column < group.sizes.cols(); ++column) {
            all[tables[group.tables[static_cast<std::size_t>(column)]].sample].push_back(group.sizes(row, column) - middle);
        }
    }
    std::map<std::string, double> levels;
    for (auto& [sample, values] : all) {
        levels[sample] = median_of(std::move(values));
    }
    return levels;
}

/// Samples that lie beside the others of their group, with the logarithm of how far.
std::map<std::string, double> samples_beside(const std::vector<AlikeTables>& groups, const std::vector<Measurement>& tables) {
    std::map<std::string, double> beside;
    for (const AlikeTables& group : groups) {
        const std::map<std::string, double> levels = levels_in(group, tables);
        for (const auto& [sample, level] : levels) {
            std::vector<double> others;
            for (const auto& [other, value] : levels) {
                if (other != sample) {
                    others.push_back(value);
                }
            }
            if (others.size() < 2) {
                continue;
            }
            const double middle = median_of(others);
            const auto [low, high] = std::minmax_element(others.begin(), others.end());
            const double scatter = std::max(usual_scatter, *high - *low);
            if (std::abs(level - middle) > sample_deviations * scatter) {
                beside[sample] = level - middle;
            }
        }
    }
    return beside;
}

}  // namespace

std::vector<Outlier> leave_out_outliers(std::vector<Measurement>& tables) {
    std::vector<Outlier> found;
    const std::vector<AlikeTables> groups = groups_of(tables);
    std::vector<std::size_t> sweeps;
    std::vector<double> deviations;
    for (std::size_t number = 0; number < tables.size(); ++number) {
        if (axis_of(tables[number]) != nullptr && find_column(tables[number], "storage_modulus") != nullptr &&
            tables[number].kind != MeasurementKind::structure_series) {
            sweeps.push_back(number);
            deviations.push_back(Sizes(tables[number]).deviation());
        }
    }
    const double usual = median_of(std::move(deviations));
    for (const std::size_t number : sweeps) {
        leave_out_rows(tables, number, groups, usual, found);
    }
    for (const auto& [sample, departure] : samples_beside(groups_of(tables), tables)) {
        for (std::size_t number = 0; number < tables.size(); ++number) {
            if (tables[number].sample != sample || find_column(tables[number], "storage_modulus") == nullptr) {
                continue;
            }
            for (std::size_t row = 0; row < tables[number].rows(); ++row) {
                leave_out(tables[number], row, "sample '" + sample + "' is an outlier");
            }
            found.push_back({number, std::nullopt, std::exp(departure), times_text(departure)});
        }
    }
    return found;
}

}  // namespace coagula::diagnose
