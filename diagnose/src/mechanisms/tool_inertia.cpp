#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

bool knows_plates_and_frequencies(const Experiment& experiment) {
    return knows_plates(experiment) && knows_frequency(experiment);
}

}  // namespace

Mechanism tool_inertia() {
    return {.name = "tool-inertia",
            .term = "the inertia of the tool is larger than the instrument corrects",
            .signature = "shifts the storage modulus by the square of the frequency and never the loss modulus",
            .parameters = {{"inertia", "kg.m2", 1e-9, 1e-4, true, &Settings::tool_inertia}},
            .in_contact = false,
            .applies = knows_plates_and_frequencies};
}

}  // namespace coagula::diagnose::mechanisms
