// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Only structures of a recipe can be made again with sizes.
Mechanism polydispersity() {
    return {.name = "polydispersity",
            .term = "the particles have a lognormal distribution of sizes; the simulated structures are generated with it",
            .signature =
                "The contact peak of the pair correlation is lower and wider, and the pores change. The coordination "
                "does not.",
            .kind = {Link::structure, Axis::distance},
            .parameters = {{"relative_size_deviation", "1", 0.02, 0.4, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.structures.size_deviation = values[0]; }},
            .applies = [](const Knows& knows) { return knows.recipe; }};
}

}  // namespace coagula::diagnose::mechanisms
