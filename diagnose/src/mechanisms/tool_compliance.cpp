#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism tool_compliance() {
    return {.name = "tool-compliance",
            .term = "the tool yields more than the instrument corrects",
            .signature = "the apparent storage modulus saturates when the sample is stiff",
            .parameters = {{"compliance", "rad/(N.m)", 5e-4, 1e-2, true, &Settings::tool_compliance}},
            .in_contact = false,
            .applies = knows_plates};
}

}  // namespace coagula::diagnose::mechanisms
