// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include <numbers>

namespace coagula::diagnose::mechanisms {

namespace {

/// Pressure over that of the contacts, below which networks come apart.
constexpr double least_pressure = -0.3;
/// Factor by which the modulus of networks stays behind the cube root of the load, because loads are uneven and some contacts
/// open.
constexpr double unevenness = 1.5;

/// Modulus of Hertz contacts, which the plates press besides their adhesion: (1 + p)^(1/3) where all loads grow alike and are
/// small.
std::complex<double> pressed(std::complex<double> modulus, const Observation& row, Values values) {
    if (!std::isfinite(row.normal_force) || !std::isfinite(row.plate_radius) || is_fluid(row) || is<Viscosity>(row)) {
        return modulus;
    }
    const double area = std::numbers::pi * row.plate_radius * row.plate_radius;
    const double pressure = std::max(row.normal_force / area / values[0], least_pressure);
    return modulus * (1 + pressure / 3 / (1 + unevenness * pressure));
}

bool shows_load(const Knows& knows) {
    return knows.radius && knows.experiment.material.kind != MaterialKind::newtonian && knows.load;
}

}  // namespace

/// Coagulated spheres of 0.5 um whose contacts hold 0.1 to 20 nN are pressed by their adhesion as by 0.2 to 50 kPa: volume fraction
/// x coordination x force / (pi d^2) (Rumpf 1970), more where they are smaller. The modulus of a packing goes as the cube root of
/// the load of its contacts (Digby 1981, with adhesion; Walton 1987); how far networks stay behind that is seen in
/// tests/benchmark/diagnosis_campaign/pressed.py, at volume fractions of 0.4 and 0.5 and coordinations of 4.3 to 5.4.
Mechanism normal_load() {
    return {.name = "normal-load",
            .term = "the plates press on the sample, and the load stiffens its contacts",
            .signature =
                "All moduli follow the recorded normal force up and down, by the same factor at every strain and "
                "frequency.",
            .kind = {Link::history, Axis::normal_force},
            .parameters = {{"contact_pressure", "Pa", 100, 1e6, true}},
            .effect = ChangesGeometry{pressed},
            .applies = shows_load,
            // A tool that gives way to the force changes the gap, a small one the most.
            .told_apart = {gaps_differ, "fresh samples at two other gaps, with the normal force"}};
}

}  // namespace coagula::diagnose::mechanisms
