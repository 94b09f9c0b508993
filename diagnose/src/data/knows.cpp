// SPDX-License-Identifier: GPL-3.0-or-later
#include "knows.hpp"

#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include <limits>

namespace coagula::diagnose {

namespace {

bool any_has(const Experiment& experiment, std::string_view column) {
    return any_measurement(experiment, [&](const Measurement& table) { return find_column(table, column) != nullptr; });
}

bool any_is(const Experiment& experiment, MeasurementKind kind) {
    return any_measurement(experiment, [&](const Measurement& table) { return table.kind == kind; });
}

bool takes_time(const Experiment& experiment) {
    const std::vector<RunTime> times = run_times(experiment);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        const bool shows = find_column(table, "storage_modulus") != nullptr || find_column(table, "viscosity") != nullptr;
        if (times[k].known && table.kind != MeasurementKind::structure_series && shows) {
            return true;
        }
    }
    return false;
}

bool oscillates_on_sample(const Measurement& table) {
    const bool moduli = find_column(table, "storage_modulus") != nullptr || find_column(table, "loss_modulus") != nullptr;
    return moduli && table.kind != MeasurementKind::structure_series && std::isnan(table.fluid_viscosity);
}

bool knows_load(const Experiment& experiment) {
    std::set<double> forces;
    for (const Measurement& table : experiment.measurements) {
        for (std::size_t row = 0; oscillates_on_sample(table) && row < table.rows(); ++row) {
            const double force = cell(table, "normal_force", row);
            if (!std::isfinite(force)) {
                return false;
            }
            forces.insert(force);
        }
    }
    return forces.size() > 1;
}

bool differs_in_geometry(const Experiment& experiment) {
    return differs(experiment, [&](const Measurement& table, std::size_t row) {
        return tool_constants(experiment.instrument, cell(table, "gap", row), cell(table, "plate_radius", row), table.cone_angle)
            .torque_per_modulus();
    });
}

/// Something shows what structures look like, or how stiff they are when their contacts are known.
bool sees_structure(const Experiment& experiment, bool moduli) {
    const bool images = any_is(experiment, MeasurementKind::coordinates) || any_is(experiment, MeasurementKind::pore_curve);
    return (images && std::isfinite(experiment.sample.particle_radius)) ||
           (moduli && std::isfinite(experiment.sample.normal_stiffness));
}

}  // namespace

bool varies(const Measurement& table, std::string_view name) {
    const Column* column = find_column(table, name);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : column == nullptr ? std::vector<double>{} : column->values) {
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    return high > 1.05 * low;
}

Knows knowledge_of(const Experiment& experiment) {
    const Instrument& instrument = experiment.instrument;
    const bool moduli =
        any_has(experiment, "storage_modulus") || any_has(experiment, "loss_modulus") || any_has(experiment, "viscosity");
    const bool torque = moduli && std::isfinite(tool_constants(instrument).torque_per_modulus());
    const bool gap = (moduli && std::isfinite(instrument.gap)) || any_has(experiment, "gap");
    const bool rim = instrument.geometry != Geometry::concentric_cylinders;
    const auto any_with = [&](double Measurement::*known) {
        return any_measurement(experiment, [&](const Measurement& table) { return std::isfinite(table.*known); });
    };
    return {.experiment = experiment,
            .moduli = moduli,
            .frequency = any_has(experiment, "angular_frequency") || any_has(experiment, "frequency"),
            .strain = any_is(experiment, MeasurementKind::amplitude_sweep) || any_has(experiment, "strain"),
            .flow = any_measurement(experiment, [](const Measurement& table) { return is_flow(table.kind); }),
            .clock = takes_time(experiment),
            .shear_before = experiment.sample.sheared_before || any_with(&Measurement::preshear),
            .load = knows_load(experiment),
            .gap = gap,
            .walls = gap || (instrument.geometry == Geometry::cone_plate && torque),
            .radius = moduli && rim && (std::isfinite(instrument.plate_radius) || any_has(experiment, "plate_radius")),
            .torque = torque,
            .geometry = experiment.material.kind != MaterialKind::smooth || differs_in_geometry(experiment),
            .level = std::isfinite(known_scale(experiment).value) || any_with(&Measurement::fluid_viscosity),
            .recipe = experiment.recipe && sees_structure(experiment, moduli)};
}

}  // namespace coagula::diagnose
