// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/measurement.hpp>

#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr std::array<std::pair<MeasurementKind, std::string_view>, 14> kind_names = {
    {{MeasurementKind::frequency_sweep, "frequency-sweep"},
     {MeasurementKind::amplitude_sweep, "amplitude-sweep"},
     {MeasurementKind::time_sweep, "time-sweep"},
     {MeasurementKind::waveform, "waveform"},
     {MeasurementKind::harmonics, "harmonics"},
     {MeasurementKind::flow_curve, "flow-curve"},
     {MeasurementKind::steady_shear, "steady-shear"},
     {MeasurementKind::creep, "creep"},
     {MeasurementKind::stress_relaxation, "stress-relaxation"},
     {MeasurementKind::start_up, "start-up"},
     {MeasurementKind::gap_series, "gap-series"},
     {MeasurementKind::structure_series, "structure-series"},
     {MeasurementKind::coordinates, "coordinates"},
     {MeasurementKind::pore_curve, "pore-curve"}}};

constexpr auto kinds = [] {
    std::array<MeasurementKind, kind_names.size()> list{};
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i] = kind_names[i].first;
    }
    return list;
}();

constexpr std::array<std::pair<Geometry, std::string_view>, 3> geometry_names = {
    {{Geometry::plate_plate, "plate-plate"},
     {Geometry::cone_plate, "cone-plate"},
     {Geometry::concentric_cylinders, "concentric-cylinders"}}};

constexpr std::array quantities = {
    Quantity{"time", "s", 0, false, infinite, "time since the start of the run"},
    Quantity{"strain", "1", -infinite, false, infinite, "shear strain: amplitude; in a waveform the momentary value"},
    Quantity{"stress", "Pa", -infinite, false, infinite, "shear stress: amplitude; in a waveform the momentary value"},
    Quantity{"storage_modulus", "Pa", -infinite, false, 1e15, "G'"},
    Quantity{"loss_modulus", "Pa", -infinite, false, 1e15, "G''"},
    Quantity{"complex_modulus", "Pa", 0, false, infinite, "|G*|"},
    Quantity{"third_harmonic_storage", "1", -infinite, false, infinite,
             "third harmonic of the stress over the first, elastic: G3'/|G*|"},
    Quantity{"third_harmonic_loss", "1", -infinite, false, infinite,
             "third harmonic of the stress over the first, viscous: G3''/|G*|"},
    Quantity{"loss_tangent", "1", -infinite, false, infinite, "G''/G'"},
    Quantity{"phase", "rad", -std::numbers::pi, false, std::numbers::pi, "phase by which the stress leads the strain"},
    Quantity{"raw_phase", "rad", -2 * std::numbers::pi, false, 2 * std::numbers::pi,
             "phase by which the torque leads the deflection, as the instrument measured it"},
    Quantity{"angular_frequency", "rad/s", 0, true, infinite, "2 pi times the frequency"},
    Quantity{"frequency", "Hz", 0, true, infinite, "cycles per second"},
    Quantity{"complex_viscosity", "Pa.s", 0, false, infinite, "|G*| over the angular frequency"},
    Quantity{"shear_rate", "1/s", 0, true, infinite, "shear rate of steady flow"},
    Quantity{"viscosity", "Pa.s", 0, true, infinite, "stress over shear rate in steady flow"},
    Quantity{"compliance", "1/Pa", 0, false, infinite, "strain over stress in a creep"},
    Quantity{"relaxation_modulus", "Pa", -infinite, false, infinite, "stress over strain in a stress relaxation"},
    Quantity{"torque", "N.m", -infinite, false, infinite, "amplitude of the torque"},
    Quantity{"deflection", "rad", -infinite, false, infinite, "amplitude of the angle of the tool"},
    Quantity{"normal_force", "N", -infinite, false, infinite,
             "normal force on the tool; it is positive where the sample pushes the plates apart"},
    Quantity{"temperature", "K", 0, true, infinite, "temperature of the sample"},
    Quantity{"gap", "m", 0, true, infinite, "gap between the plates"},
    Quantity{"plate_radius", "m", 0, true, infinite, "radius of the plate or cone, where tables differ in it"},
    Quantity{"volume_fraction", "1", 0, true, 1, "volume fraction of the particles"},
    Quantity{"heterogeneity", "1", 0, true, infinite, "degree of heterogeneity a, in particle radii"},
    Quantity{"coordination", "1", 0, false, infinite, "mean number of contacts"},
    Quantity{"structure", "1", 1, false, infinite, "number of the group of structures that stand for the row"},
    Quantity{"rattler_fraction", "1", 0, false, 1, "particles with fewer than three contacts"},
    Quantity{"x", "m", -infinite, false, infinite, "centre"},
    Quantity{"y", "m", -infinite, false, infinite, "centre"},
    Quantity{"z", "m", -infinite, false, infinite, "centre"},
    Quantity{"frame", "1", -infinite, false, infinite, "number of one of several images of the same particles"},
    Quantity{"particle_radius", "m", 0, true, infinite, ""},
    Quantity{"pore_radius", "m", 0, false, infinite, "distance from the nearest particle surface"},
    Quantity{"exclusion_probability", "1", 0, false, 1, "part of the void space farther from any surface than that"},
};

template <class Value, std::size_t size>
std::string_view name_in(const std::array<std::pair<Value, std::string_view>, size>& names, Value value) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == value; });
    return found == names.end() ? std::string_view{} : found->second;
}

template <class Value, std::size_t size>
std::optional<Value> value_in(const std::array<std::pair<Value, std::string_view>, size>& names, std::string_view name) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.second == name; });
    return found == names.end() ? std::nullopt : std::optional<Value>(found->first);
}

/// A parameter that is unset or satisfies the rule.
void check_parameter(double value, const std::string& name, bool (*holds)(double), const char* rule) {
    if (!std::isnan(value) && !(std::isfinite(value) && holds(value))) {
        throw InputError(name + " is " + to_text(value) + ", but " + rule);
    }
}

bool positive(double value) {
    return value > 0;
}

/// Wide enough for every parameter in SI units, narrow enough that products of some stay in the range of numbers.
bool physical(double value) {
    return value >= 1e-30 && value <= 1e30;
}

void check_positive(double value, const char* name, const char* unit) {
    check_parameter(value, name, positive, (std::string("must be > 0 ") + unit).c_str());
    check_parameter(value, name, physical, (std::string("must lie between 1e-30 and 1e+30 ") + unit).c_str());
}

void check_sample(const Sample& sample) {
    check_positive(sample.particle_radius, "sample.particle_radius", "m");
    check_positive(sample.density, "sample.density", "kg/m3");
    check_positive(sample.solvent_viscosity, "sample.solvent_viscosity", "Pa.s");
    check_positive(sample.temperature, "sample.temperature", "K");
    check_positive(sample.normal_stiffness, "sample.normal_stiffness", "N/m");
    check_positive(sample.normal_stiffness_error, "sample.normal_stiffness_error", "");
    if (std::isnan(sample.normal_stiffness) != std::isnan(sample.normal_stiffness_error)) {
        throw InputError("sample.normal_stiffness and sample.normal_stiffness_error go together: give both or none");
    }
    check_parameter(
        sample.volume_fraction, "sample.volume_fraction", [](double value) { return value > 0 && value < 0.75; },
        "must lie above 0 and below 0.75, more than spheres can fill");
}

void refuse_if_set(double value, const char* name, const Instrument& instrument) {
    if (!std::isnan(value)) {
        throw InputError(std::string(name) + " is given, but a " + std::string(name_of(*instrument.geometry)) +
                         " geometry has none");
    }
}

void check_cone(double angle, const std::string& name) {
    check_parameter(
        angle, name, [](double value) { return value > 0 && value < std::numbers::pi / 4; }, "must lie between 0 and pi/4 rad");
}

/// A table that was measured under a cone in place of the upper one of two plates.
void check_exchanged_cone(const Measurement& measurement, const Instrument& instrument) {
    check_cone(measurement.cone_angle, measurement.label + ": cone_angle");
    if (std::isnan(measurement.cone_angle)) {
        return;
    }
    if (instrument.geometry != Geometry::plate_plate) {
        throw InputError(measurement.label +
                         ": cone_angle is that of a cone in place of a plate, but instrument.geometry is not plate-plate");
    }
    if (find_column(measurement, "gap") != nullptr) {
        throw InputError(measurement.label + ": a gap and a cone_angle are given, but under a cone the gap is not constant");
    }
}

void check_instrument(const Instrument& instrument) {
    check_positive(instrument.plate_radius, "instrument.plate_radius", "m");
    check_positive(instrument.gap, "instrument.gap", "m");
    check_positive(instrument.inner_radius, "instrument.inner_radius", "m");
    check_positive(instrument.outer_radius, "instrument.outer_radius", "m");
    check_positive(instrument.bob_length, "instrument.bob_length", "m");
    check_positive(instrument.stress_constant, "instrument.stress_constant", "Pa/(N.m)");
    check_positive(instrument.strain_constant, "instrument.strain_constant", "1/rad");
    check_parameter(
        instrument.end_correction, "instrument.end_correction", [](double value) { return value >= 1 && value < 2; },
        "must be 1 or more and below 2");
    if (std::isnan(instrument.stress_constant) != std::isnan(instrument.strain_constant)) {
        throw InputError("instrument.stress_constant and instrument.strain_constant go together: give both or none");
    }
    check_positive(instrument.tool_inertia, "instrument.tool_inertia", "kg.m2");
    check_positive(instrument.instrument_inertia, "instrument.instrument_inertia", "kg.m2");
    check_positive(instrument.tool_compliance, "instrument.tool_compliance", "rad/(N.m)");
    check_cone(instrument.cone_angle, "instrument.cone_angle");
    if (std::isnan(instrument.inner_radius) != std::isnan(instrument.outer_radius)) {
        throw InputError("instrument.inner_radius and instrument.outer_radius go together: give both or none");
    }
    if (instrument.outer_radius <= instrument.inner_radius) {
        throw InputError("instrument.outer_radius is " + to_text(instrument.outer_radius) + " m, but must exceed inner_radius, " +
                         to_text(instrument.inner_radius) + " m");
    }
    if (instrument.gap >= instrument.plate_radius) {
        throw InputError("instrument.gap is " + to_text(instrument.gap) + " m, but must be below plate_radius, " +
                         to_text(instrument.plate_radius) + " m");
    }
    if (instrument.geometry && instrument.geometry != Geometry::cone_plate) {
        refuse_if_set(instrument.cone_angle, "instrument.cone_angle", instrument);
    }
    if (instrument.geometry && instrument.geometry != Geometry::concentric_cylinders) {
        refuse_if_set(instrument.inner_radius, "instrument.inner_radius", instrument);
        refuse_if_set(instrument.outer_radius, "instrument.outer_radius", instrument);
        refuse_if_set(instrument.bob_length, "instrument.bob_length", instrument);
    }
}

/// A number that is too large for its unit, a step of time times a row, a period of the frequency zero.
void refuse_infinite(const Measurement& measurement, const Column& column) {
    for (const std::vector<double>* values : {&column.values, &column.standard_errors}) {
        const auto place = std::find_if(values->begin(), values->end(), [](double value) { return std::isinf(value); });
        if (place != values->end()) {
            throw InputError(measurement.label + ": '" + column.name + "' is infinite in row " +
                             std::to_string(place - values->begin() + 1) + "; check the values and units that it follows from");
        }
    }
}

}  // namespace

std::string_view name_of(MeasurementKind kind) {
    return name_in(kind_names, kind);
}

std::optional<MeasurementKind> measurement_kind(std::string_view name) {
    return value_in(kind_names, name);
}

std::span<const MeasurementKind> all_measurement_kinds() {
    return kinds;
}

bool has_moduli(MeasurementKind kind) {
    return kind == MeasurementKind::frequency_sweep || kind == MeasurementKind::amplitude_sweep ||
           kind == MeasurementKind::time_sweep || kind == MeasurementKind::gap_series || kind == MeasurementKind::structure_series;
}

bool is_flow(MeasurementKind kind) {
    return kind == MeasurementKind::flow_curve || kind == MeasurementKind::steady_shear;
}

bool is_step_test(MeasurementKind kind) {
    return kind == MeasurementKind::creep || kind == MeasurementKind::stress_relaxation || kind == MeasurementKind::start_up;
}

std::string_view name_of(Geometry geometry) {
    return name_in(geometry_names, geometry);
}

std::optional<Geometry> geometry(std::string_view name) {
    return value_in(geometry_names, name);
}

std::span<const Quantity> all_quantities() {
    return quantities;
}

const Quantity* find_quantity(std::string_view name) {
    const auto* const found =
        std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& quantity) { return quantity.name == name; });
    return found == quantities.end() ? nullptr : &*found;
}

TableRule rule_of(MeasurementKind kind) {
    switch (kind) {
        case MeasurementKind::frequency_sweep:
            return {{"angular_frequency"}, {"storage_modulus"}, 5, true};
        case MeasurementKind::amplitude_sweep:
            return {{"strain"}, {"storage_modulus"}, 5, true};
        case MeasurementKind::time_sweep:
            return {{"time"}, {"storage_modulus"}, 5, true};
        case MeasurementKind::waveform:
            return {{"time"}, {"strain", "stress"}, 16, true};
        case MeasurementKind::harmonics:
            return {{"strain"}, {"third_harmonic_storage"}, 4, true};
        case MeasurementKind::flow_curve:
            return {{"shear_rate"}, {"viscosity"}, 5, true};
        case MeasurementKind::steady_shear:
            return {{"time"}, {"viscosity", "shear_rate"}, 5, true};
        case MeasurementKind::creep:
            return {{"time"}, {"compliance"}, 8, true};
        case MeasurementKind::stress_relaxation:
            return {{"time"}, {"relaxation_modulus"}, 8, true};
        case MeasurementKind::start_up:
            return {{"time"}, {"viscosity"}, 8, true};
        case MeasurementKind::gap_series:
            return {{"gap"}, {"storage_modulus"}, 4, false};  // in no order, a drift in time does not follow the gap
        case MeasurementKind::structure_series:
            return {{"heterogeneity", "coordination", "volume_fraction"}, {"storage_modulus"}, 4, false};
        case MeasurementKind::coordinates:
            return {{}, {"x", "y", "z"}, 5, false};
        case MeasurementKind::pore_curve:
            return {{"pore_radius"}, {"exclusion_probability"}, 5, true};
    }
    throw std::invalid_argument("there is no such kind of measurement");
}

const Column* find_column(const Measurement& measurement, std::string_view name) {
    const auto& columns = measurement.columns;
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
    return found == columns.end() ? nullptr : &*found;
}

const Column* axis_of(const Measurement& measurement) {
    for (const std::string_view name : rule_of(measurement.kind).axes) {
        if (const Column* column = find_column(measurement, name)) {
            return column;
        }
    }
    return nullptr;
}

void check(const Experiment& experiment) {
    check_sample(experiment.sample);
    check_material(experiment);
    check_instrument(experiment.instrument);
    if (!experiment.structures.empty() && experiment.recipe) {
        throw InputError("structures are given both as files and as a recipe");
    }
    if (!experiment.structure_groups.empty() && experiment.structure_groups.size() != experiment.structures.size()) {
        throw InputError("structures.groups has " + std::to_string(experiment.structure_groups.size()) +
                         " numbers, but structures.files has " + std::to_string(experiment.structures.size()) + " files");
    }
    for (const Measurement& measurement : experiment.measurements) {
        check_exchanged_cone(measurement, experiment.instrument);
        for (const Column& column : measurement.columns) {
            require(column.values.size() == measurement.rows(), measurement.label + ": the columns have different lengths");
            refuse_infinite(measurement, column);
        }
    }
}

}  // namespace coagula::diagnose
