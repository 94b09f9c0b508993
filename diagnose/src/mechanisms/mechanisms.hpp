// Conditions on an experiment that the mechanisms, one file each, share.
#pragma once

#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "data/table_cells.hpp"
#include "observables/observations.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

namespace coagula::diagnose::mechanisms {

/// Step of critical strains along their priors, 0 .. 1: 1 % of the strain, less than structures can resolve.
constexpr double strength_step = 1.0 / 920;

constexpr double usual_gap = 1e-3;  ///< where none is known [m]

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

/// Whether the distance of the walls is known: between plates, or under a cone of known angle and radius.
inline bool knows_walls(const Experiment& experiment) {
    return knows_gap(experiment) || (experiment.instrument.geometry == Geometry::cone_plate && knows_tool(experiment));
}

/// Some table has moduli or viscosities that were measured one after the other, and it is known when.
inline bool takes_time(const Experiment& experiment) {
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

/// The normal force was recorded in every row of every oscillation on the sample, and is not the same in all.
bool knows_load(const Experiment& experiment);

/// The plates are there, with a rim: their radius is known.
inline bool knows_radius(const Experiment& experiment) {
    const auto states = [](const Measurement& table) { return find_column(table, "plate_radius") != nullptr; };
    const bool cylinders = experiment.instrument.geometry == Geometry::concentric_cylinders;
    return has_moduli(experiment) && !cylinders &&
           (std::isfinite(experiment.instrument.plate_radius) || any_measurement(experiment, states));
}

/// Something was measured that shows what structures look like, or how stiff they are when their contacts are known.
inline bool sees_structure(const Experiment& experiment) {
    const bool images = any_measurement(experiment, [](const Measurement& table) {
        return table.kind == MeasurementKind::coordinates || table.kind == MeasurementKind::pore_curve;
    });
    return (images && std::isfinite(experiment.sample.particle_radius)) ||
           (has_moduli(experiment) && std::isfinite(experiment.sample.normal_stiffness));
}

/// Structures come from a recipe, so that they can be made again, and something shows what they look like.
inline bool sees_recipe(const Experiment& experiment) {
    return experiment.recipe && sees_structure(experiment);
}

/// The volume fraction that is stated lies between these.
inline bool states_volume_fraction(const Experiment& experiment, double lowest, double highest) {
    return experiment.sample.volume_fraction >= lowest && experiment.sample.volume_fraction <= highest;
}

inline bool sees_void_expansion(const Experiment& experiment) {
    return sees_recipe(experiment) && experiment.recipe->generator == "vem";
}

/// A coordination that the generators come to at most volume fractions.
inline bool has_usual_coordination(const StructureRecipe& recipe) {
    return std::isnan(recipe.target_coordination) || (recipe.target_coordination >= 4.5 && recipe.target_coordination <= 4.9);
}

/// As many voids as half of the particles or fewer: where there are more, loose packings do not come to their coordination.
inline bool has_few_voids(const StructureRecipe& recipe) {
    return recipe.voids == 0 || (8 * recipe.voids >= recipe.particles && 2 * recipe.voids <= recipe.particles);
}

/// Whether what `of_row` says of the rows of all tables differs by more than a twentieth.
template <class OfRow>
bool differs(const Experiment& experiment, const OfRow& of_row) {
    std::set<double> all;
    for (const Measurement& table : experiment.measurements) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (const double value = of_row(table, row); std::isfinite(value)) {
                all.insert(value);
            }
        }
    }
    return !all.empty() && *all.rbegin() > 1.05 * *all.begin();
}

/// Whether a column of a table varies by more than a twentieth.
inline bool varies(const Measurement& table, std::string_view name) {
    const Column* column = find_column(table, name);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : column == nullptr ? std::vector<double>{} : column->values) {
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    return high > 1.05 * low;
}

/// What changes every row alike is told from a material that nobody has a model of only where tables differ in gap or plate.
inline bool shows_geometry(const Experiment& experiment) {
    const auto torque_per_modulus = [&](const Measurement& table, std::size_t row) {
        return tool_constants(experiment.instrument, cell(table, "gap", row), cell(table, "plate_radius", row), table.cone_angle)
            .torque_per_modulus();
    };
    return experiment.material.kind != MaterialKind::smooth || differs(experiment, torque_per_modulus);
}

inline bool differ_in_radius(const Experiment& experiment) {
    return differs(experiment, [&](const Measurement& table, std::size_t row) {
        const double own = cell(table, "plate_radius", row);
        return std::isnan(own) ? experiment.instrument.plate_radius : own;
    });
}

/// The modulus that particles or an oil should have is known, and not its course alone.
inline bool knows_level(const Experiment& experiment) {
    return std::isfinite(known_scale(experiment).value) ||
           any_measurement(experiment, [](const Measurement& table) { return std::isfinite(table.fluid_viscosity); });
}

/// What the layers of a sample that has settled, in series, do to the modulus of a row; 1 where nobody knows the gap.
/// @param difference of the volume fraction between the plates at the gap of the instrument, 1 mm where that is not known.
std::complex<double> settled_layers(const Observation& row, double difference, const SimulatedSample& sample);

/// Layers between plates are in series; what the modulus of a layer is, structures of other volume fractions say.
bool can_settle_between_plates(const Experiment& experiment);

/// Every run follows a shear that destroyed the structure, or some does.
inline bool is_sheared_before(const Experiment& experiment) {
    return experiment.sample.sheared_before ||
           any_measurement(experiment, [](const Measurement& table) { return std::isfinite(table.preshear); });
}

/// (1 + age / time)^exponent, of an exponent and a time [s].
inline std::complex<double> power_of_age(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    return std::isfinite(row.age) ? std::pow(1 + row.age / values[1], values[0]) : 1;
}

inline bool knows_frequency(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) {
        return find_column(table, "angular_frequency") != nullptr || find_column(table, "frequency") != nullptr;
    });
}

inline bool flows(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) { return table.kind == MeasurementKind::flow_curve; });
}

/// A smooth viscosity may grow towards low rates in any way.
inline bool flows_as_an_oil(const Experiment& experiment) {
    return experiment.material.kind == MaterialKind::newtonian && flows(experiment);
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
