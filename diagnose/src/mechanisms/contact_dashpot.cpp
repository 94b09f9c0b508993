// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Kelvin and Voigt (Ferry, Viscoelastic Properties of Polymers, 1980, ch. 3): a film of solvent or polymer that is sheared and
/// squeezed in the contact.
Mechanism contact_dashpot() {
    return {.name = "contact-dashpot",
            .term =
                "a film in the contacts resists their motion in proportion to its speed: a dashpot acts beside their "
                "springs",
            .signature =
                "The loss modulus is the storage modulus times the frequency and one time constant, at every "
                "frequency and age, and the storage modulus does not change. Three causes look similar: 'solvent- "
                "drag' raises the storage modulus with the frequency; 'bearing-damping' does not follow the stiffness "
                "of the sample and falls with the plate's radius; 'contact-relaxation' levels off above one over its "
                "relaxation time.",
            .kind = {Link::material, Axis::frequency},
            .parameters = {{"dashpot_time", "s", 1e-6, 1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.dashpot_time = values[0]; }},
            .applies = [](const Knows& knows) { return knows.frequency; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
