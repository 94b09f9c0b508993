// What the mechanisms, one file each, share: what an experiment must say for them.
#pragma once

#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "observables/observations.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

namespace coagula::diagnose::mechanisms {

/// Of the places of critical strains in their priors: 1 % of the strain, less than structures can tell.
constexpr double strength_step = 1.0 / 920;

inline bool any_measurement(const Experiment& experiment, bool (*holds)(const Measurement&)) {
    return std::any_of(experiment.measurements.begin(), experiment.measurements.end(), holds);
}

/// Some table has moduli.
inline bool has_moduli(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) {
        return find_column(table, "storage_modulus") != nullptr || find_column(table, "loss_modulus") != nullptr ||
               find_column(table, "viscosity") != nullptr;
    });
}

/// Torque per angle over the modulus is known.
inline bool knows_tool(const Experiment& experiment) {
    return has_moduli(experiment) && std::isfinite(tool_constants(experiment.instrument).torque_per_modulus());
}

inline bool knows_gap(const Experiment& experiment) {
    return (has_moduli(experiment) && std::isfinite(experiment.instrument.gap)) ||
           any_measurement(experiment, [](const Measurement& table) { return find_column(table, "gap") != nullptr; });
}

/// How far the walls are apart is known: between plates, or under a cone of known angle and radius.
inline bool knows_walls(const Experiment& experiment) {
    return knows_gap(experiment) || (experiment.instrument.geometry == Geometry::cone_plate && knows_tool(experiment));
}

/// Some table has moduli that were measured one after the other, and it is known when.
inline bool takes_time(const Experiment& experiment) {
    const std::vector<RunTime> times = run_times(experiment);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        if (times[k].known && table.kind != MeasurementKind::structure_series && find_column(table, "storage_modulus") != nullptr) {
            return true;
        }
    }
    return false;
}

/// Something was measured that shows what structures look like, or how stiff they are when their contacts are known.
inline bool sees_structure(const Experiment& experiment) {
    const bool images = any_measurement(experiment, [](const Measurement& table) {
        return table.kind == MeasurementKind::coordinates || table.kind == MeasurementKind::pore_curve;
    });
    return (images && std::isfinite(experiment.sample.particle_radius)) ||
           (has_moduli(experiment) && std::isfinite(experiment.sample.normal_stiffness));
}

/// What changes every row alike is told from a material that nobody has a model of only where tables differ in gap or plate.
inline bool shows_geometry(const Experiment& experiment) {
    if (experiment.material.kind != MaterialKind::smooth) {
        return true;
    }
    std::set<double> all;
    for (const Measurement& table : experiment.measurements) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const auto in_row = [&](const char* name) {
                const Column* column = find_column(table, name);
                return column == nullptr ? unset : column->values[row];
            };
            all.insert(tool_constants(experiment.instrument, in_row("gap"), in_row("plate_radius"), table.cone_angle)
                           .torque_per_modulus());
        }
    }
    return !all.empty() && *all.rbegin() > 1.05 * *all.begin();
}

inline bool knows_frequency(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) {
        return find_column(table, "angular_frequency") != nullptr || find_column(table, "frequency") != nullptr;
    });
}

inline bool flows(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) { return table.kind == MeasurementKind::flow_curve; });
}

inline bool knows_tool_and_frequencies(const Experiment& experiment) {
    return knows_tool(experiment) && knows_frequency(experiment);
}

inline bool sweeps_amplitude(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) {
        return table.kind == MeasurementKind::amplitude_sweep || find_column(table, "strain") != nullptr;
    });
}

}  // namespace coagula::diagnose::mechanisms
