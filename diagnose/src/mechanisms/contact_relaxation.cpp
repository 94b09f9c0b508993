// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// A Maxwell element (Ferry, Viscoelastic Properties of Polymers, 1980, ch. 3): a part of the contact, such as a polymer bridge,
/// that lets go and takes hold again within one time.
Mechanism contact_relaxation() {
    return {.name = "contact-relaxation",
            .term = "a part of every contact force relaxes: a spring in series with a dashpot acts beside the springs",
            .signature =
                "The storage modulus rises by a step around one frequency, where the loss modulus has its maximum. "
                "Far below that frequency this looks like 'contact-dashpot' and 'solvent-drag', and over a decade or "
                "less like 'contact-loss'; higher and lower frequencies separate them.",
            .kind = {Link::material, Axis::frequency},
            .parameters = {{"relaxing_over_spring", "1", 3e-3, 10, true}, {"contact_relaxation_time", "s", 1e-3, 1e3, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) {
                settings.relaxing_ratio = values[0];
                settings.relaxation_time = values[1];
            }},
            .applies = [](const Knows& knows) { return knows.frequency; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
