// SPDX-License-Identifier: GPL-3.0-or-later
#include "observations.hpp"

#include "data/table_cells.hpp"
#include "neighbour_shells.hpp"
#include "row_conditions.hpp"
#include "structure_observations.hpp"

#include <coagula/diagnose/waveform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

namespace coagula::diagnose {

namespace {

/// A column that shows a response to shear, and what it shows.
struct Shown {
    std::string_view column;
    decltype(Observation::what) what;
};

/// Columns that a table may have, in the order of their observations.
std::span<const Shown> shown_in(const Measurement& table) {
    static const std::array of_oscillations{
        Shown{"storage_modulus", Modulus{}}, Shown{"loss_modulus", Modulus{.loss = true, .of_phase = true}},
        Shown{"third_harmonic_storage", Harmonic{}}, Shown{"third_harmonic_loss", Harmonic{.loss = true}}};
    static const std::array of_flow{Shown{"viscosity", Viscosity{}}};
    return is_flow(table.kind) ? std::span<const Shown>(of_flow) : std::span<const Shown>(of_oscillations);
}

/// The errors of torque and phase at a row: as near as can be, G' has the one and G'' the other.
void take_polar_errors(const Measurement& table, const ErrorSpec& errors, Observation& one, Modulus& modulus) {
    const ColumnErrors& torque = *find_errors(errors, one.measurement, "storage_modulus");
    const ColumnErrors& across = *find_errors(errors, one.measurement, "loss_modulus");
    const double phase = std::atan2(cell(table, "loss_modulus", one.row), cell(table, "storage_modulus", one.row));
    if (!std::isnan(phase)) {
        modulus.turned = std::remainder(phase, std::numbers::pi / 2);
        const bool liquid = std::lround((phase - modulus.turned) / (std::numbers::pi / 2)) % 2 != 0;
        modulus.of_phase = modulus.loss != liquid;
    }
    const ColumnErrors& own = modulus.of_phase ? across : torque;
    one.errors = own.law;
    one.standard_error = own.deviations[one.row];
    modulus.other_error = (modulus.of_phase ? torque : across).deviations[one.row];
}

/// The cell of a column at these conditions.
Observation observation_at(const RowConditions& conditions, const Measurement& table, std::size_t number, std::size_t row,
                           const Shown& shown, const ErrorSpec& errors) {
    const Column& column = *find_column(table, shown.column);
    Observation one{conditions, number, row, shown.what, column.values[row]};
    if (!column.standard_errors.empty()) {
        one.standard_error = column.standard_errors[row];
    } else if (const ColumnErrors* known = find_errors(errors, number, shown.column)) {
        one.standard_error = known->deviations[row];
        one.errors = known->law;
    } else if (is<Harmonic>(one)) {
        one.standard_error = unstated_harmonic_error;
    }
    if (auto* modulus = std::get_if<Modulus>(&one.what);
        modulus != nullptr && number < errors.tables.size() && errors.tables[number].polar) {
        take_polar_errors(table, errors, one, *modulus);
    }
    if (auto* viscosity = std::get_if<Viscosity>(&one.what)) {
        viscosity->shear_rate = cell(table, "shear_rate", row);
    }
    return one;
}

/// Whether the table states gap or plates in other rows and not in this one: those of the instrument would be wrong here.
bool lacks_geometry(const Measurement& table, std::size_t row) {
    const auto is_lost = [&](const char* name) {
        const Column* column = find_column(table, name);
        return column != nullptr && !std::isfinite(column->values[row]) &&
               std::any_of(column->values.begin(), column->values.end(), [](double value) { return std::isfinite(value); });
    };
    return is_lost("gap") || is_lost("plate_radius");
}

/// Adds what a table shows of a response to shear.
void add_sheared(std::vector<Observation>& all, const Experiment& experiment, const ConditionsOfRows& conditions, std::size_t run,
                 const ErrorSpec& errors) {
    const Measurement& table = experiment.measurements[run];
    const bool flows = is_flow(table.kind);
    const bool fluid = std::isfinite(table.fluid_viscosity);
    for (const Shown& shown : shown_in(table)) {
        const Column* column = find_column(table, shown.column);
        // A fluid stores nothing, loses in proportion to the frequency, and has no harmonics.
        const bool takes_part = column != nullptr && (!fluid || flows || shown.column == "loss_modulus");
        for (std::size_t row = 0; takes_part && row < table.rows(); ++row) {
            if (!std::isfinite(column->values[row]) || (fluid && !flows && std::isnan(angular_frequency(table, row))) ||
                (flows && std::isnan(cell(table, "shear_rate", row))) || lacks_geometry(table, row)) {
                continue;
            }
            all.push_back(observation_at(conditions.of(run, row), table, run, row, shown, errors));
        }
    }
}

/// Whether the number is compared as it stands.
bool is_share(const Observation& observation) {
    return is<Harmonic>(observation) || is<ImageDifference>(observation);
}

}  // namespace

const Observable& observable_of(const Observation& observation) {
    if (const auto* difference = as<ImageDifference>(observation)) {
        constexpr std::array keys{"localisation_plane", "localisation_axis", "unmatched_share"};
        return observable_named(keys.at(static_cast<std::size_t>(difference->quantity)));
    }
    if (is<Neighbours>(observation)) {
        return observable_named(is_along_axis(observation.row) ? "neighbours_axis" : "neighbours_plane");
    }
    if (is<Pore>(observation)) {
        return observable_named("exclusion_probability");
    }
    if (is<Viscosity>(observation)) {
        return observable_named("viscosity");
    }
    if (is<Harmonic>(observation)) {
        return observable_named(is_loss(observation) ? "third_harmonic_loss" : "third_harmonic_storage");
    }
    return observable_named(is_loss(observation) ? "loss_modulus" : "storage_modulus");
}

bool has_error_of_phase(const Observation& observation) {
    const auto* modulus = as<Modulus>(observation);
    return modulus != nullptr ? modulus->of_phase : is<Harmonic>(observation) && is_loss(observation);
}

double relative_to(const Observation& observation, double level) {
    if (is_modulus_or_viscosity(observation)) {
        return level;
    }
    return is<Neighbours>(observation) ? std::max(level, 1.0) : 1.0;
}

std::vector<Observation> observations_of(const Experiment& experiment, const ErrorSpec& errors) {
    const ConditionsOfRows conditions(experiment);
    std::vector<Observation> all;
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        if (table.kind == MeasurementKind::coordinates && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> seen = seen_in_images(experiment, k);
            all.insert(all.end(), seen.begin(), seen.end());
        }
        if (table.kind == MeasurementKind::pore_curve && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> pores = pores_in(experiment, k);
            all.insert(all.end(), pores.begin(), pores.end());
        }
        if (shows_shear(table)) {
            add_sheared(all, experiment, conditions, k, errors);
        }
    }
    return all;
}

void put_values(const std::vector<Observation>& observations, const Eigen::VectorXd& values, Experiment& experiment) {
    for (std::size_t k = 0; k < observations.size(); ++k) {
        std::vector<Column>& columns = experiment.measurements[observations[k].measurement].columns;
        const std::string_view key = observable_of(observations[k]).key;
        const auto column = std::find_if(columns.begin(), columns.end(), [&](const Column& one) { return one.name == key; });
        column->values[observations[k].row] = values[static_cast<Index>(k)];
    }
}

Eigen::ArrayXd complex_moduli(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli) {
    std::map<std::pair<std::size_t, std::size_t>, double> squares;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double value = is_share(observations[k]) ? 0.0 : moduli[static_cast<Index>(k)];
        squares[{observations[k].measurement, observations[k].row}] += value * value;
    }
    Eigen::ArrayXd sizes(moduli.size());
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double square = squares[{observations[k].measurement, observations[k].row}];
        sizes[static_cast<Index>(k)] = is_share(observations[k]) ? 1.0 : std::sqrt(square);
    }
    return sizes;
}

}  // namespace coagula::diagnose
