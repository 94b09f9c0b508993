#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism bond_range() {
    return {.name = "bond-range",
            .term = "particles are bonded over another distance than 1 % of the diameter",
            .signature = "coordination and modulus rise together",
            .parameters = {{"tolerance", "1", 1e-3, 0.05, true, &Settings::bond_tolerance}},
            .in_contact = false,
            .applies = has_moduli};
}

}  // namespace coagula::diagnose::mechanisms
