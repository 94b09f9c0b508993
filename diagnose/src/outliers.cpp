#include <coagula/diagnose/outliers.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/noise.hpp>

#include "median.hpp"
#include "table_cells.hpp"

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

/// Deviation of normal numbers of which this is the median size.
double robust_deviation(std::vector<double> values) {
    for (double& value : values) {
        value = std::abs(value);
    }
    return 1.4826 * median_of(std::move(values));
}

/// Tables that were measured alike: by row of the first one, logarithms of the sizes, tables as columns.
struct Group {
    std::vector<std::size_t> tables;
    std::vector<double> axis;
    Eigen::MatrixXd sizes;  ///< conditions x tables
};

std::vector<Group> groups_of(const std::vector<Measurement>& tables) {
    std::vector<Group> groups;
    for (const Replicates& replicates : find_replicates(tables)) {
        if (replicates.observable != "storage_modulus" || replicates.values.cols() < fewest_tables) {
            continue;
        }
        Group group{{}, {replicates.axis.begin(), replicates.axis.end()}, {}};
        group.sizes.setConstant(replicates.axis.size(), replicates.values.cols(), unset);
        for (Eigen::Index column = 0; column < replicates.values.cols(); ++column) {
            const auto found = std::find_if(tables.begin(), tables.end(), [&](const Measurement& table) {
                return table.label == replicates.labels[static_cast<std::size_t>(column)] &&
                       table.sample == replicates.samples[static_cast<std::size_t>(column)];
            });
            group.tables.push_back(static_cast<std::size_t>(found - tables.begin()));
            const std::vector<double>& axis = axis_of(*found)->values;
            for (std::size_t row = 0; row < axis.size(); ++row) {
                const auto same =
                    std::find_if(group.axis.begin(), group.axis.end(), [&](double one) { return alike(one, axis[row]); });
                if (same != group.axis.end()) {
                    group.sizes(same - group.axis.begin(), column) = log_size(*found, row);
                }
            }
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

/// What the other tables of its group say about the logarithm of a size, shifted to the level of its own table; NaN where there are
/// too few.
double by_the_others(const Group& group, std::size_t table, double place) {
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

/// How far a row lies beside both of its neighbours, to the same side: 0 on a slope or a step.
double beside_neighbours(const std::vector<double>& sizes, std::size_t row) {
    const double before = sizes[row] - sizes[row - 1];
    const double after = sizes[row] - sizes[row + 1];
    return before * after > 0 ? std::copysign(std::min(std::abs(before), std::abs(after)), before) : 0.0;
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

void leave_out_rows(std::vector<Measurement>& tables, std::size_t number, const std::vector<Group>& groups,
                    std::vector<Outlier>& found) {
    Measurement& table = tables[number];
    std::vector<double> sizes;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (const double size = log_size(table, row); std::isfinite(size)) {
            sizes.push_back(size);
            rows.push_back(row);
        }
    }
    std::vector<double> bends;
    for (std::size_t k = 1; k + 1 < sizes.size(); ++k) {
        bends.push_back(sizes[k] - 0.5 * (sizes[k - 1] + sizes[k + 1]));
    }
    const double deviation = bends.size() < 3 ? unset : robust_deviation(bends) / std::sqrt(1.5);
    for (std::size_t k = 1; k + 1 < sizes.size() && std::isfinite(deviation); ++k) {
        const double departure = beside_neighbours(sizes, k);
        const double limit = std::max(row_deviations * deviation, least_departure);
        const double place = axis_of(table)->values[rows[k]];
        const bool confirmed = std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
            return std::abs(sizes[k] - by_the_others(group, number, place)) < 0.5 * std::abs(departure);
        });
        if (std::abs(departure) > limit && !confirmed) {
            const std::string what = "|G*| is " + times_text(departure) + " in the rows beside it";
            leave_out(table, rows[k], "outlier: " + what);
            found.push_back({number, rows[k], std::exp(departure),
                             table.label + ", sample '" + table.sample + "': row " + std::to_string(rows[k] + 1) +
                                 " is left out as an outlier, " + what});
        }
    }
}

/// Median logarithmic distance of every sample of a group from the others.
std::map<std::string, double> levels_in(const Group& group, const std::vector<Measurement>& tables) {
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
std::map<std::string, double> samples_beside(const std::vector<Group>& groups, const std::vector<Measurement>& tables) {
    std::map<std::string, double> beside;
    for (const Group& group : groups) {
        const std::map<std::string, double> levels = levels_in(group, tables);
        for (const auto& [sample, level] : levels) {
            std::vector<double> others;
            for (const auto& [other, value] : levels) {
                if (other != sample) {
                    others.push_back(value);
                }
            }
            const double middle = median_of(others);
            const auto [low, high] = std::minmax_element(others.begin(), others.end());
            const double scatter = std::max(usual_scatter, *high - *low);
            if (others.size() >= 2 && std::abs(level - middle) > sample_deviations * scatter) {
                beside[sample] = level - middle;
            }
        }
    }
    return beside;
}

}  // namespace

std::vector<Outlier> leave_out_outliers(std::vector<Measurement>& tables) {
    std::vector<Outlier> found;
    const std::vector<Group> groups = groups_of(tables);
    for (std::size_t number = 0; number < tables.size(); ++number) {
        if (axis_of(tables[number]) != nullptr && find_column(tables[number], "storage_modulus") != nullptr &&
            tables[number].kind != MeasurementKind::structure_series) {
            leave_out_rows(tables, number, groups, found);
        }
    }
    for (const auto& [sample, departure] : samples_beside(groups_of(tables), tables)) {
        for (std::size_t number = 0; number < tables.size(); ++number) {
            if (tables[number].sample != sample || find_column(tables[number], "storage_modulus") == nullptr) {
                continue;
            }
            for (std::size_t row = 0; row < tables[number].rows(); ++row) {
                leave_out(tables[number], row, "sample '" + sample + "' is an outlier");
            }
            found.push_back({number, std::nullopt, std::exp(departure),
                             tables[number].label + ": sample '" + sample + "' is left out as an outlier, its |G*| is " +
                                 times_text(departure) + " that of the others"});
        }
    }
    return found;
}

}  // namespace coagula::diagnose
