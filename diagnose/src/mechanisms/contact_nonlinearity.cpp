// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism contact_nonlinearity() {
    return {.name = "contact-nonlinearity",
            .term = "the contacts follow Hertz's law instead of linear springs",
            .signature =
                "The storage modulus rises as the square root of the strain once this exceeds the strain of the load "
                "at rest. It is the same on the way down in strain as on the way up, whatever the age.",
            .kind = {Link::material, Axis::strain},
            .parameters = {{"preload_overlap", "1", 1e-7, 3e-2, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.contact_preload = values[0]; }},
            .applies = [](const Knows& knows) { return knows.strain; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
