// SPDX-License-Identifier: GPL-3.0-or-later
// Measured data as plain values: columns in SI units, what was left out and why, and the experiment they belong to.
#pragma once

#include <coagula/common/checks.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::diagnose {

/// Kind of a measurement: the quantity and its axis.
enum class MeasurementKind {
    frequency_sweep,    ///< moduli against angular frequency at one strain amplitude
    amplitude_sweep,    ///< moduli against strain amplitude at one frequency
    time_sweep,         ///< moduli against time at one strain amplitude and frequency
    waveform,           ///< strain and stress against time within an oscillation
    harmonics,          ///< third harmonic of the stress against strain amplitude
    flow_curve,         ///< viscosity against shear rate in steady flow
    steady_shear,       ///< viscosity against time at one shear rate
    creep,              ///< strain or compliance against time after a step of the stress
    stress_relaxation,  ///< stress or relaxation modulus against time after a step of the strain
    start_up,           ///< stress or viscosity against time after a step of the shear rate
    gap_series,         ///< moduli against the gap between the plates
    structure_series,   ///< moduli against what characterises the structure: heterogeneity, coordination, volume fraction
    coordinates,        ///< centres of particles
    pore_curve,         ///< exclusion probability against distance from the particle surfaces
};

/// "frequency-sweep", ...
std::string_view name_of(MeasurementKind kind);
std::optional<MeasurementKind> measurement_kind(std::string_view name);
std::span<const MeasurementKind> all_measurement_kinds();
/// Whether tables of this kind hold G' or G''.
bool has_moduli(MeasurementKind kind);
/// Whether tables of this kind hold viscosities in steady flow.
bool is_flow(MeasurementKind kind);
/// Whether tables of this kind are steps that are compared as moduli against frequency (step_test.hpp).
bool is_step_test(MeasurementKind kind);

/// A column that a table may have.
struct Quantity {
    std::string_view name;  ///< "storage_modulus"
    std::string_view unit;  ///< SI, UDUNITS text
    double low;             ///< values below are impossible; `low` itself too where `low_excluded`
    bool low_excluded;
    double high;
    std::string_view meaning;
};

std::span<const Quantity> all_quantities();
/// Null when there is none of this name.
const Quantity* find_quantity(std::string_view name);

/// Requirements on a table of this kind.
struct TableRule {
    std::vector<std::string_view> axes;      ///< the axis is the first of these that the table has; empty: none
    std::vector<std::string_view> required;  ///< besides the axis
    std::size_t fewest_rows;                 ///< with a readable axis and all required columns
    bool ordered;                            ///< the axis runs in one direction
};
TableRule rule_of(MeasurementKind kind);

struct Column {
    std::string name;                          ///< of a quantity
    std::string unit;                          ///< SI
    std::vector<double> values;                ///< one per row; NaN where the cell is empty or left out
    std::vector<double> standard_errors = {};  ///< that the table states, one per row in the same unit, or none
};

/// A cell that is not used.
struct LeftOutCell {
    std::string column;
    std::size_t row;    ///< from 0
    std::string value;  ///< as it was read
    std::string reason;
};

/// One table: one sweep on one sample.
struct Measurement {
    MeasurementKind kind = MeasurementKind::frequency_sweep;
    std::string label;        ///< names the table in messages: file, section, point
    std::string sample;       ///< tables of one sample share its random effect
    int run_order = 0;        ///< position in the sequence of runs on this sample
    double start = unset;     ///< of the run, on one clock for all tables [s]; NaN: not known
    double pause = unset;     ///< between the run before it, or the filling, and this run or its pre-shear [s]
    double preshear = unset;  ///< how long a shear right before the run took that destroyed the structure [s]; NaN: none
    /// Whether its times are those of a clock that all runs on the sample share; without a word the times themselves tell.
    std::optional<bool> shared_clock = {};
    /// Whether the stress was set and the strain followed; without a word the rows tell.
    std::optional<bool> stress_controlled = {};
    std::string instrument = {};     ///< that it was measured on, where somebody said
    bool rough_plates = false;       ///< nothing slips there
    bool solvent_trap = false;       ///< nothing dries there
    double cone_angle = unset;       ///< of a cone in place of the upper one of two plates [rad]
    double fluid_viscosity = unset;  ///< of a Newtonian fluid in place of the sample [Pa.s]; it does not slip, either
    double rate_before = 0;          ///< of a start-up: the shear rate that it begins from [1/s]
    double stress_before = 0;        ///< of a start-up: the steady stress at that rate [Pa]
    int oscillations = 1;            ///< at the strain of a row, of which the last is measured; >= 1
    std::vector<Column> columns;
    std::vector<LeftOutCell> left_out;

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// Null when the table has no such column.
const Column* find_column(const Measurement& measurement, std::string_view name);
/// The column that is the axis of its kind; null when there is none.
const Column* axis_of(const Measurement& measurement);

/// Particles and solvent; unset (NaN) where not stated.
struct Sample {
    std::string name;
    double particle_radius = unset;         ///< m
    double density = unset;                 ///< of the particles, kg/m3
    double volume_fraction = unset;         ///< 0 .. 1
    double solvent_viscosity = unset;       ///< Pa.s
    double temperature = unset;             ///< K
    double normal_stiffness = unset;        ///< of a particle, where it is known [N/m]
    double normal_stiffness_error = unset;  ///< standard deviation of its logarithm
    bool sheared_before = false;            ///< every run follows a shear that destroyed the structure
};

/// Base model of the sample.
enum class MaterialKind {
    network,    ///< simulated structures of bonded particles
    newtonian,  ///< G* = i w eta
    smooth,     ///< no model: any smooth G* of what it varies with
};
/// "network", "newtonian", "smooth".
std::string_view name_of(MaterialKind kind);
std::optional<MaterialKind> material_kind(std::string_view name);

struct Material {
    MaterialKind kind = MaterialKind::network;
    double viscosity = unset;        ///< of a Newtonian one, where it is known [Pa.s]
    double viscosity_error = unset;  ///< standard deviation of its logarithm
    bool ages = false;               ///< a smooth one varies with its age, too
};

enum class Geometry { plate_plate, cone_plate, concentric_cylinders };
std::string_view name_of(Geometry geometry);
std::optional<Geometry> geometry(std::string_view name);

/// The rheometer; unset (NaN) where nobody said.
struct Instrument {
    std::optional<Geometry> geometry;
    double plate_radius = unset;        ///< m; of the cone or plate
    double gap = unset;                 ///< m
    double cone_angle = unset;          ///< rad
    double inner_radius = unset;        ///< m; concentric cylinders
    double outer_radius = unset;        ///< m
    double bob_length = unset;          ///< m; of the inner cylinder
    double end_correction = 1;          ///< on the torque of the inner cylinder: 1.1 of one after DIN 53019
    double stress_constant = unset;     ///< stress over torque where it is stated [Pa/(N.m)]
    double strain_constant = unset;     ///< strain over deflection where it is stated [1/rad]
    double tool_inertia = unset;        ///< kg.m2
    double instrument_inertia = unset;  ///< of the shaft that turns with the tool [kg.m2]
    double tool_compliance = unset;     ///< rad/(N.m)
};

/// Recipe for structures of the sample where none are given as files.
struct StructureRecipe {
    std::string generator;  ///< "vem" or "brownian"
    int particles = 0;
    int voids = 0;                        ///< vem
    double surface_potential = unset;     ///< V, brownian
    double target_coordination = unset;   ///< 1
    std::vector<std::size_t> seeds = {};  ///< one structure each
};

struct Experiment {
    std::string title;
    Sample sample;
    Material material;
    Instrument instrument;
    std::vector<std::string> structures;  ///< paths of HDF5 files
    /// One per structure: which rows of a structure series it stands for, those with this number in `structure`, from 1; empty: all
    /// stand for the same sample.
    std::vector<std::size_t> structure_groups;
    std::vector<std::size_t> structure_sizes;        ///< particles of each structure, once it has been read
    std::vector<double> structure_volume_fractions;  ///< of each structure, once it has been read
    std::optional<StructureRecipe> recipe;           ///< otherwise
    std::vector<Measurement> measurements;
};

/// Adds the viscosity of a table of steady flow that has stress and shear rate only.
void derive_viscosity(Measurement& table);

/// Throws InputError when sample, instrument and recipe contradict themselves or each other (gap 0, outer radius below inner ...).
void check(const Experiment& experiment);

/// The one number that scales the moduli of the material, as far as it is known: the normal stiffness of a particle [N/m] or a
/// viscosity [Pa.s], and the standard deviation of its logarithm; both NaN where nobody knows it.
struct KnownScale {
    double value = unset;
    double error = unset;
};
KnownScale known_scale(const Experiment& experiment);

}  // namespace coagula::diagnose
