#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism bond_strength() {
    return {.name = "bond-strength",
            .term = "bonds break at a finite force",
            .signature =
                "the storage modulus falls and the loss modulus rises past a yield strain; it does not come back on the way down",
            .parameters = {{"critical_strain", "1", 3e-6, 3e-2, true, &Settings::critical_strain, strength_step}},
            .in_contact = true,
            .applies = sweeps_amplitude};
}

}  // namespace coagula::diagnose::mechanisms
