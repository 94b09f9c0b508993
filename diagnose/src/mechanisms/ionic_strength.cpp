// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double least_potential = 0.012;  // V: up to it particles of 0.25 um have no barrier that ions could lower

/// Behind a thinner double layer the barrier is lower than that of the recipe, so that whatever the recipe makes coagulates sooner.
bool coagulates_over_barrier(const Knows& knows) {
    return knows.recipe && knows.experiment.recipe->generator == "brownian" &&
           std::abs(knows.experiment.recipe->surface_potential) > least_potential;
}

}  // namespace

/// The recipe has a Debye length of 10 nm, or 0.9 mol/m3 of a salt of monovalent ions. More comes from powder that dissolves and
/// from a reaction that sets ions free (Gauckler, Graule and Baader, Mater. Chem. Phys. 61 (1999) 78). Beyond four times as much
/// the suspension is less ordered before it coagulates, and structures are more heterogeneous again.
Mechanism ionic_strength() {
    return {.name = "ionic-strength",
            .term =
                "the suspension holds more ions than the recipe assumes, so that the double layers are thinner and the energy "
                "barrier between the particles is lower",
            .signature =
                "Where the barrier is lower, structures of equal coordination are less heterogeneous: their pores are "
                "smaller, and fewer neighbours lie within two diameters. A lower 'surface-potential' does the same.",
            .kind = {Link::structure, Axis::heterogeneity},
            .parameters = {{"ionic_strength_over_recipe", "1", 1, 4, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.ionic_strength = values[0]; }},
            .applies = coagulates_over_barrier};
}

}  // namespace coagula::diagnose::mechanisms
