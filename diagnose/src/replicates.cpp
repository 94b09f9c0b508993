#include <coagula/diagnose/noise.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t fewest_shared = 3;
constexpr std::size_t none = static_cast<std::size_t>(-1);

bool has_moduli(MeasurementKind kind) {
    return kind == MeasurementKind::frequency_sweep || kind == MeasurementKind::amplitude_sweep ||
           kind == MeasurementKind::time_sweep || kind == MeasurementKind::gap_series;
}

/// Median of a column; NaN without one.
double typical(const Measurement& table, std::string_view name) {
    const Column* column = find_column(table, name);
    std::vector<double> values;
    if (column != nullptr) {
        std::copy_if(column->values.begin(), column->values.end(), std::back_inserter(values),
                     [](double value) { return std::isfinite(value); });
    }
    if (values.empty()) {
        return unset;
    }
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// The rows of a table in the order of their axis values, the first of equal ones first.
class RowsByAxis {
public:
    explicit RowsByAxis(const Measurement& table) {
        const std::vector<double>& axis = axis_of(table)->values;
        for (std::size_t row = 0; row < axis.size(); ++row) {
            if (std::isfinite(axis[row])) {
                rows_.emplace_back(axis[row], row);
            }
        }
        std::sort(rows_.begin(), rows_.end());
    }

    /// The row nearest to this axis value, if it is alike.
    std::optional<std::size_t> at(double position) const {
        const auto above = first_from(position);
        std::pair<double, std::size_t> nearest{unset, 0};
        if (above != rows_.end() && alike(above->first, position)) {
            nearest = {above->first - position, above->second};
        }
        if (above != rows_.begin()) {
            const auto below = first_from(std::prev(above)->first);
            if (alike(below->first, position)) {
                const std::pair<double, std::size_t> other{position - below->first, below->second};
                nearest = std::isnan(nearest.first) ? other : std::min(nearest, other);
            }
        }
        return std::isnan(nearest.first) ? std::nullopt : std::optional(nearest.second);
    }

private:
    std::vector<std::pair<double, std::size_t>>::const_iterator first_from(double position) const {
        return std::lower_bound(rows_.begin(), rows_.end(), std::pair<double, std::size_t>{position, 0});
    }

    std::vector<std::pair<double, std::size_t>> rows_;
};

/// Whether an axis goes up more often than down.
bool goes_up(const Measurement& table) {
    const std::vector<double>& axis = axis_of(table)->values;
    int steps = 0;
    for (std::size_t row = 1; row < axis.size(); ++row) {
        steps += axis[row] > axis[row - 1] ? 1 : (axis[row] < axis[row - 1] ? -1 : 0);
    }
    return steps >= 0;
}

/// What comes later on a sample, or goes the other way, may differ by physics.
bool are_replicates(const Measurement& a, const Measurement& b) {
    if (!measured_alike(a, b)) {
        return false;
    }
    if (a.kind != b.kind || axis_of(a)->name != axis_of(b)->name || a.run_order != b.run_order || goes_up(a) != goes_up(b)) {
        return false;
    }
    for (const char* name : {"angular_frequency", "strain", "gap", "plate_radius"}) {
        const double one = typical(a, name);
        const double other = typical(b, name);
        if (name != axis_of(a)->name && !std::isnan(one) && !std::isnan(other) && !alike(one, other)) {
            return false;
        }
    }
    const std::vector<double>& axis = axis_of(a)->values;
    const RowsByAxis rows(b);
    const auto shared =
        std::count_if(axis.begin(), axis.end(), [&](double position) { return std::isfinite(position) && rows.at(position); });
    return static_cast<std::size_t>(shared) >= fewest_shared;
}

using Group = std::vector<const Measurement*>;

std::vector<Group> group(const std::vector<Measurement>& measurements) {
    std::vector<Group> groups;
    for (const Measurement& table : measurements) {
        if (!has_moduli(table.kind) || axis_of(table) == nullptr) {
            continue;
        }
        const auto found =
            std::find_if(groups.begin(), groups.end(), [&](const Group& other) { return are_replicates(*other.front(), table); });
        if (found == groups.end()) {
            groups.push_back({&table});
        } else {
            found->push_back(&table);
        }
    }
    return groups;
}

/// One over the strain amplitude of each row, a cell without a value taken as the typical one; empty where the strain is not known.
std::vector<double> floor_weights(const Measurement& table) {
    const Column* strain = find_column(table, "strain");
    const double usual = typical(table, "strain");
    if (!(usual > 0)) {
        return {};
    }
    std::vector<double> weights;
    for (const double value : strain->values) {
        weights.push_back(1 / (value > 0 ? value : usual));
    }
    return weights;
}

/// Conditions are the axis values of the first table.
Replicates replicates_in(const Group& tables, const Column& observable) {
    const std::vector<double>& axis = axis_of(*tables.front())->values;
    Replicates replicates{tables.front()->kind, observable.name, observable.unit, {}, {}, {}, {}, false, {}, {}};
    replicates.axis = Eigen::VectorXd::Map(axis.data(), static_cast<Eigen::Index>(axis.size()));
    replicates.fluid = std::isfinite(tables.front()->fluid_viscosity);
    const std::vector<double> weights = floor_weights(*tables.front());
    replicates.floor_of_stress = !weights.empty();
    replicates.floor_weights = Eigen::VectorXd::Ones(replicates.axis.size());
    if (replicates.floor_of_stress) {
        replicates.floor_weights = Eigen::VectorXd::Map(weights.data(), replicates.axis.size());
    }
    replicates.complex_moduli.setConstant(replicates.axis.size(), unset);
    replicates.values.setConstant(replicates.axis.size(), static_cast<Eigen::Index>(tables.size()), unset);
    std::vector<RowsByAxis> rows;
    for (const Measurement* table : tables) {
        rows.emplace_back(*table);
        replicates.samples.push_back(table->sample);
        replicates.labels.push_back(table->label);
    }
    for (std::size_t row = 0; row < axis.size(); ++row) {
        std::vector<double> sizes;
        for (std::size_t k = 0; k < tables.size(); ++k) {
            const std::size_t there = std::isfinite(axis[row]) ? rows[k].at(axis[row]).value_or(none) : none;
            if (const Column* column = find_column(*tables[k], observable.name); column != nullptr && there != none) {
                replicates.values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k)) = column->values[there];
                sizes.push_back(complex_modulus(*tables[k], there));
            }
        }
        replicates.complex_moduli[static_cast<Eigen::Index>(row)] =
            sizes.empty() ? unset : std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
    }
    return replicates;
}

}  // namespace

std::vector<Replicates> find_replicates(const std::vector<Measurement>& measurements) {
    std::vector<Replicates> all;
    for (const Group& tables : group(measurements)) {
        for (const char* name : {"storage_modulus", "loss_modulus"}) {
            if (const Column* observable = find_column(*tables.front(), name)) {
                all.push_back(replicates_in(tables, *observable));
            }
        }
    }
    return all;
}

}  // namespace coagula::diagnose
