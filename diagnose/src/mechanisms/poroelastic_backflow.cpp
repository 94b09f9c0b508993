// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Solvent leaves what the plates squeeze in the time gap^2 / (12 G mobility), whatever their radius.
std::complex<double> drained(std::complex<double> modulus, const Observation& row, Values values) {
    if (!std::isfinite(row.time) || !std::isfinite(row.gap) || is_fluid(row)) {
        return modulus;
    }
    const double per_time = 12 * std::abs(modulus) * values[1] / (row.gap * row.gap);
    return modulus * (1 - values[0] * std::expm1(-row.time * per_time));
}

/// A gap that changes under a sample squeezes anew, which the law does not know.
bool changes_gap(const Measurement& table) {
    return varies(table, "gap") && !std::isfinite(table.fluid_viscosity);
}

bool drains(const Knows& knows) {
    const bool plates = knows.experiment.instrument.geometry.value_or(Geometry::plate_plate) == Geometry::plate_plate;
    return plates && knows.gap && knows.clock && knows.experiment.material.kind != MaterialKind::newtonian &&
           !any_measurement(knows.experiment, changes_gap);
}

}  // namespace

/// Consolidation (Biot, Journal of Applied Physics 12 (1941) 155) of a layer that sticks to both plates and is thin against their
/// radius, where the network has to shear as it gives way sideways (of one side that sticks: Ateshian and others, Journal of
/// Biomechanics 27 (1994) 1347). Strains of 0.5 to 10 % are left by filling, and G' grows as the volume fraction to a power of 2 to
/// 6. By Kozeny and Carman the permeability is 3e-18 m2 for spheres of 20 nm and 2e-15 m2 for 0.5 um at a volume fraction of 0.4.
Mechanism poroelastic_backflow() {
    return {
        .name = "poroelastic-backflow",
        .term =
            "the filling compresses the network and its solvent together; the solvent then leaves through the "
            "pores, and the network becomes denser",
        .signature =
            "All moduli grow with the time since the filling and level off, by the same factor at every gap. The "
            "time that this takes is proportional to the square of the gap over the modulus, whatever the plate's "
            "radius.",
        .kind = {Link::history, Axis::time},
        .parameters = {{"drained_growth", "1", 0.02, 0.5, true}, {"permeability_over_viscosity", "m2/(Pa s)", 1e-16, 1e-10, true}},
        .effect = ChangesGeometry{drained},
        .applies = drains,
        .told_apart = {gaps_differ, "fresh samples at two other gaps"}};
}

}  // namespace coagula::diagnose::mechanisms
