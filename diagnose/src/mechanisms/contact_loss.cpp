#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism contact_loss() {
    return {.name = "contact-loss",
            .term = "the contacts lose energy: a springpot beside their springs",
            .signature = "a loss modulus that is flat or a weak power of frequency, from the lowest strain on",
            .parameters = {{"springpot_over_spring", "1", 0.03, 10, true, &Settings::springpot_ratio},
                           {"exponent", "1", 0.01, 0.3, true, &Settings::springpot_exponent}},
            .in_contact = true,
            .applies = knows_frequency};
}

}  // namespace coagula::diagnose::mechanisms
