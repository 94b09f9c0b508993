#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Kelvin and Voigt (Ferry, Viscoelastic Properties of Polymers, 1980, ch. 3): a film of solvent or polymer that is sheared and
/// squeezed in the contact.
Mechanism contact_dashpot() {
    return {.name = "contact-dashpot",
            .term = "a film in the contacts resists their motion in proportion to its speed: a dashpot beside their springs",
            .signature =
                "a loss modulus that is the storage modulus times the frequency and one time, at all frequencies and ages, and a "
                "storage modulus that does not change; 'solvent-drag' raises the storage modulus with the frequency, "
                "'bearing-damping' does not follow the stiffness of the sample and falls with the plate's radius, and "
                "'contact-relaxation' bends where the frequency passes one over its time",
            .parameters = {{"dashpot_time", "s", 1e-6, 1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.dashpot_time = values[0]; }},
            .applies = knows_frequency,
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
