#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism shear_stiffness() {
    return {.name = "shear-stiffness",
            .term = "the shear stiffness of a contact is another part of its normal stiffness than the 0.1 of the base model",
            .signature = "a nearly constant factor on all moduli that depends a little on coordination",
            .parameters = {{"shear_over_normal", "1", 0.05, 1, true, &Settings::stiffness_ratio}},
            .in_contact = true,
            .applies = has_moduli};
}

}  // namespace coagula::diagnose::mechanisms
