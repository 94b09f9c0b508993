// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// The part of 0 .. 60 mV at which the generator coagulates: at 15 mV the barrier between particles of 0.25 um is 6 kT high and the
/// simulation of 0.15 s takes 400 times as long as without barrier, at 18 mV it is 17 kT and nothing coagulates. It grows with the
/// radius.
constexpr double highest_potential = 0.015;  // V
constexpr double largest_radius = 0.26e-6;   // m

bool coagulates(const Knows& knows) {
    return knows.recipe && knows.experiment.recipe->generator == "brownian" &&
           knows.experiment.sample.particle_radius <= largest_radius;
}

}  // namespace

/// Only structures that coagulate by a recipe can coagulate again.
Mechanism surface_potential() {
    return {
        .name = "surface-potential",
        .term =
            "the particles coagulated at another surface potential, with a higher or lower energy barrier between "
            "them",
        .signature =
            "Behind a barrier of some kT, structures of equal coordination are more heterogeneous: their pores "
            "are larger, and more neighbours lie within two diameters.",
        .kind = {Link::structure, Axis::heterogeneity},
        .parameters = {{"surface_potential", "V", 0, highest_potential, false}},
        .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.surface_potential = values[0]; }},
        .applies = coagulates};
}

}  // namespace coagula::diagnose::mechanisms
