#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism ageing() {
    return {.name = "ageing",
            .term = "the contacts grow stiffer with the age of the sample",
            .signature = "follows the order of the runs and the time, not the strain",
            .parameters = {{"per_decade", "1", 0.02, 0.3, true, &Settings::ageing_per_decade}},
            .in_contact = true,
            .applies = takes_time};
}

}  // namespace coagula::diagnose::mechanisms
