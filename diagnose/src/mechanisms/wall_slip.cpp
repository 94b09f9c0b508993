#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism wall_slip() {
    return {.name = "wall-slip",
            .term = "the sample slips at the plates",
            .signature = "the apparent modulus is the lower the stiffer the sample and the smaller the gap",
            .parameters = {{"slip_length_over_modulus", "m/Pa", 1e-12, 1e-7, true, &Settings::slip}},
            .in_contact = false,
            .applies = knows_walls};
}

}  // namespace coagula::diagnose::mechanisms
