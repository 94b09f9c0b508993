// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism contact_loss() {
    return {.name = "contact-loss",
            .term = "the contacts lose energy at all frequencies: a springpot acts beside their springs",
            .signature = "The loss modulus is flat or a weak power of the frequency, from the lowest strain on.",
            .kind = {Link::material, Axis::frequency},
            .parameters = {{"springpot_over_spring", "1", 0.03, 10, true}, {"exponent", "1", 0.01, 0.3, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) {
                settings.springpot_ratio = values[0];
                settings.springpot_exponent = values[1];
            }},
            .applies = [](const Knows& knows) { return knows.frequency; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
