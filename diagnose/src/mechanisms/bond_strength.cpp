// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism bond_strength() {
    return {.name = "bond-strength",
            .term = "bonds break at a finite force",
            .signature =
                "Beyond a yield strain the storage modulus falls and the loss modulus rises. On the way down in "
                "strain the moduli do not recover.",
            .kind = {Link::material, Axis::strain},
            .parameters = {{"critical_strain", "1", 3e-6, 3e-2, true, strength_step}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) {
                settings.critical_strain = std::min(settings.critical_strain, values[0]);
            }},
            .applies = [](const Knows& knows) { return knows.strain; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
