// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"
#include "recipes.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Void expansion comes to all coordinations of the range there. Coagulation comes to the upper ones after minutes only.
bool can_be_aimed_at(const Knows& knows) {
    return sees_void_expansion(knows) && states_volume_fraction(knows, 0.3, 0.5) && has_few_voids(*knows.experiment.recipe);
}

}  // namespace

/// No sample comes with its coordination: the recipe has one by convention.
Mechanism coordination() {
    return {.name = "coordination",
            .term =
                "particles have another number of contacts than the recipe aims at; the simulated structures are "
                "generated with that number",
            .signature =
                "The contact peak of the pair correlation follows the coordination, while the pores hardly change. "
                "All moduli are higher or lower by one factor.",
            .kind = {Link::structure, Axis::coordination},
            .parameters = {{"coordination", "1", 4.3, 5.1, false}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.coordination = values[0]; }},
            .applies = can_be_aimed_at};
}

}  // namespace coagula::diagnose::mechanisms
