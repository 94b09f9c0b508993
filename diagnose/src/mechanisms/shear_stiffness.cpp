// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism shear_stiffness() {
    return {.name = "shear-stiffness",
            .term = "the ratio of a contact's shear stiffness to its normal stiffness is not the 0.1 of the base model",
            .signature = "All moduli change by nearly one factor, which depends a little on the coordination.",
            .kind = {Link::material, Axis::level},
            .parameters = {{"shear_over_normal", "1", 0.05, 1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.stiffness_ratio = values[0]; }},
            .applies = [](const Knows& knows) { return knows.moduli; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
