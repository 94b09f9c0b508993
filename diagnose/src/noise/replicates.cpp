// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/run_clock.hpp>

#include "data/table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr std::size_t fewest_shared = 3;
constexpr std::size_t none = static_cast<std::size_t>(-1);

bool can_be_repeated(MeasurementKind kind) {
    return (has_moduli(kind) && kind != MeasurementKind::structure_series) || is_flow(kind);
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

/// Whether an axis goes up in time more often than down.
bool goes_up(const Measurement& table) {
    const std::vector<double>& axis = axis_of(table)->values;
    const std::vector<std::size_t> rows = rows_in_time(table);
    int steps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double step = axis[rows[k]] - axis[rows[k - 1]];
        steps += step > 0 ? 1 : (step < 0 ? -1 : 0);
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
    for (const std::string_view name : {"angular_frequency", "strain", "gap", "plate_radius"}) {
        const double one = typical(a, name);
        const double other = typical(b, name);
        // A gap or plate that nobody states may be any; a strain or frequency is left out where it is the usual one.
        const bool of_tool = name == "gap" || name == "plate_radius";
        const bool unknown = of_tool ? std::isnan(one) && std::isnan(other) : std::isnan(one) || std::isnan(other);
        if (name != axis_of(a)->name && !unknown && !alike(one, other)) {
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
        if (!can_be_repeated(table.kind) || axis_of(table) == nullptr) {
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

/// One over the strain amplitude, or the shear rate, of each row, a cell without a value taken as the typical one; empty where the
/// strain is not known.
std::vector<double> floor_weights(const Measurement& table) {
    const char* name = is_flow(table.kind) ? "shear_rate" : "strain";
    const Column* strain = find_column(table, name);
    const double usual = typical(table, name);
    if (!(usual > 0)) {
        return {};
    }
    std::vector<double> weights;
    for (const double value : strain->values) {
        weights.push_back(1 / (value > 0 ? value : usual));
    }
    return weights;
}

/// Whether both moduli of every table are there.
bool has_phase(const Group& tables) {
    return std::all_of(tables.begin(), tables.end(), [](const Measurement* table) {
        return find_column(*table, "storage_modulus") != nullptr && find_column(*table, "loss_modulus") != nullptr;
    });
}

/// The values of a column. Conditions are the axis values of the first table.
Replicates replicates_in(const Group& tables, const Column& observable) {
    const std::vector<double>& axis = axis_of(*tables.front())->values;
    Replicates replicates{tables.front()->kind, observable.name, observable.unit, {}, {}, {}, {}};
    replicates.axis = Eigen::VectorXd::Map(axis.data(), static_cast<Eigen::Index>(axis.size()));
    const std::vector<double> weights = floor_weights(*tables.front());
    replicates.floor_of_stress = !weights.empty();
    replicates.floor_weights = Eigen::VectorXd::Ones(replicates.axis.size());
    if (replicates.floor_of_stress) {
        replicates.floor_weights = Eigen::VectorXd::Map(weights.data(), replicates.axis.size());
    }
    replicates.values.setConstant(replicates.axis.size(), static_cast<Eigen::Index>(tables.size()), unset);
    std::vector<RowsByAxis> rows;
    for (const Measurement* table : tables) {
        rows.emplace_back(*table);
        replicates.samples.push_back(table->sample);
        replicates.labels.push_back(table->label);
    }
    for (std::size_t row = 0; row < axis.size(); ++row) {
        for (std::size_t k = 0; k < tables.size(); ++k) {
            const std::size_t there = std::isfinite(axis[row]) ? rows[k].at(axis[row]).value_or(none) : none;
            if (const Column* column = find_column(*tables[k], observable.name); column != nullptr && there != none) {
                replicates.values(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k)) = column->values[there];
            }
        }
    }
    return replicates;
}

/// The normal force in the place of the values; NaN where a table has none.
Eigen::MatrixXd forces_in(const Group& tables) {
    const Column force{"normal_force", "N", {}};
    return replicates_in(tables, force).values;
}

/// What is left of each row and then of each column without its mean.
Eigen::MatrixXd without_means(Eigen::MatrixXd values) {
    values.colwise() -= values.rowwise().mean().eval();
    values.rowwise() -= values.colwise().mean().eval();
    return values;
}

/// Samples that are pressed by different forces stiffen differently in the course of a run. That is no error: the part of the
/// values that follows the force is taken out of them (least squares in the rows that all tables have).
void take_out_load(Replicates& replicates, const Group& tables) {
    constexpr double resolution = 0.1;  // N: what transducers drift by within hours
    const Eigen::MatrixXd forces = forces_in(tables);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index row = 0; row < forces.rows(); ++row) {
        if (forces.row(row).allFinite() && replicates.values.row(row).allFinite() && replicates.values.row(row).mean() != 0) {
            rows.push_back(row);
        }
    }
    if (rows.size() < fewest_shared || tables.size() < 2) {
        return;
    }
    const Eigen::MatrixXd loads = without_means(forces(rows, Eigen::all));
    if (loads.cwiseAbs().maxCoeff() < resolution) {
        return;
    }
    const Eigen::VectorXd means = replicates.values(rows, Eigen::all).rowwise().mean();
    const Eigen::MatrixXd relative = means.cwiseInverse().asDiagonal() * replicates.values(rows, Eigen::all);
    const double per_force = loads.cwiseProduct(without_means(relative)).sum() / loads.squaredNorm();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        replicates.values.row(rows[k]) -= means[static_cast<Eigen::Index>(k)] * per_force * loads.row(static_cast<Eigen::Index>(k));
    }
    replicates.fitted = 1;
}

/// |G*| along its mean over the tables, and what lies at right angles to that.
std::pair<Replicates, Replicates> torque_and_phase(const Replicates& storage, const Replicates& loss) {
    std::pair<Replicates, Replicates> both{storage, storage};
    auto& [modulus, phase] = both;
    modulus.observable = "complex_modulus";
    phase.observable = "phase";
    phase.levels.setConstant(storage.axis.size(), unset);
    for (Eigen::Index row = 0; row < storage.values.rows(); ++row) {
        const auto known = (storage.values.row(row) + loss.values.row(row)).array().isFinite();
        const auto mean = [&](const Replicates& part) {
            return known.select(part.values.row(row).array(), 0.0).sum() / static_cast<double>(known.count());
        };
        const double size = std::hypot(mean(storage), mean(loss));
        const double cosine = mean(storage) / size;
        const double sine = mean(loss) / size;
        modulus.values.row(row) = cosine * storage.values.row(row) + sine * loss.values.row(row);
        phase.values.row(row) = cosine * loss.values.row(row) - sine * storage.values.row(row);
        phase.levels[row] = size;
    }
    return both;
}

}  // namespace

std::vector<Replicates> find_replicates(const std::vector<Measurement>& measurements) {
    std::vector<Replicates> all;
    for (const Group& tables : group(measurements)) {
        const Measurement& first = *tables.front();
        const auto add = [&](Replicates replicates) {
            std::transform(tables.begin(), tables.end(), std::back_inserter(replicates.tables),
                           [&](const Measurement* table) { return static_cast<std::size_t>(table - measurements.data()); });
            all.push_back(std::move(replicates));
        };
        // A fluid stores nothing.
        const Column* storage =
            std::isnan(first.fluid_viscosity) && has_moduli(first.kind) ? find_column(first, "storage_modulus") : nullptr;
        const Column* loss = find_column(first, is_flow(first.kind) ? "viscosity" : "loss_modulus");
        if (storage != nullptr && loss != nullptr && has_phase(tables)) {
            auto [modulus, phase] = torque_and_phase(replicates_in(tables, *storage), replicates_in(tables, *loss));
            take_out_load(modulus, tables);
            add(std::move(modulus));
            add(std::move(phase));
            continue;
        }
        for (const Column* one : {storage, loss}) {
            if (one != nullptr) {
                add(replicates_in(tables, *one));
                take_out_load(all.back(), tables);
            }
        }
    }
    return all;
}

}  // namespace coagula::diagnose
