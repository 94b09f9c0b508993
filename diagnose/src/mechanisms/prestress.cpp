// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Tension, as in a gel that would shrink. Compression of every bond makes networks as loose as gels buckle: no sample is in that
/// state.
Mechanism prestress() {
    return {.name = "prestress",
            .term = "all contacts are under tension at rest, and this force resists sideways motion",
            .signature = "The moduli are higher, most where the coordination is low, at all strains and frequencies alike.",
            .kind = {Link::material, Axis::coordination},
            .parameters = {{"tension_over_stiffness", "1", 1e-4, 1e-2, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.tension = values[0]; }},
            .applies = [](const Knows& knows) { return knows.moduli; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
