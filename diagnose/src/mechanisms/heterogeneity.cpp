// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"
#include "recipes.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Void expansion comes to the coordination there, with all numbers of voids of the range.
bool can_have_other_voids(const Knows& knows) {
    return sees_void_expansion(knows) && states_volume_fraction(knows, 0.35, 0.45) &&
           has_usual_coordination(*knows.experiment.recipe);
}

}  // namespace

/// The fewer voids push the particles together, the more heterogeneous is what void expansion makes (Schenker et al. 2012).
Mechanism heterogeneity() {
    return {.name = "heterogeneity",
            .term =
                "the sample is more or less heterogeneous than the recipe's structures; simulated structures are "
                "generated with another number of voids",
            .signature =
                "With fewer voids per particle the pores are larger and more neighbours lie within two diameters, at "
                "equal coordination.",
            .kind = {Link::structure, Axis::heterogeneity},
            .parameters = {{"voids_per_particle", "1", 0.125, 1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.voids = values[0]; }},
            .applies = can_have_other_voids};
}

}  // namespace coagula::diagnose::mechanisms
