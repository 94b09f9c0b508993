#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism shear_stiffness() {
    return {.name = "shear-stiffness",
            .term = "the shear stiffness of a contact is another part of its normal stiffness than the 0.1 of the base model",
            .signature = "a nearly constant factor on all moduli that depends a little on coordination",
            .parameters = {{"shear_over_normal", "1", 0.05, 1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.stiffness_ratio = values[0]; }},
            .applies = has_moduli,
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
