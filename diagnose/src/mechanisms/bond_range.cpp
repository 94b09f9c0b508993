// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism bond_range() {
    return {.name = "bond-range",
            .term = "particles are bonded up to another distance than 1 % of the diameter, which the base model takes",
            .signature = "Coordination and modulus are higher together, or lower together.",
            .kind = {Link::structure, Axis::level},
            .parameters = {{"tolerance", "1", 1e-3, 0.05, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.bond_tolerance = values[0]; }},
            .applies = [](const Knows& knows) { return knows.moduli; }};
}

}  // namespace coagula::diagnose::mechanisms
