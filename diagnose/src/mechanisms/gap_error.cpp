#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism gap_error() {
    return {.name = "gap-error",
            .term = "the gap is larger than stated",
            .signature = "all moduli lower by one factor, more at small gaps, also in a Newtonian oil",
            .parameters = {{"gap_error", "m", 1e-5, 6e-5, true, &Settings::gap_error}},
            .in_contact = false,
            .applies = knows_gap};
}

}  // namespace coagula::diagnose::mechanisms
