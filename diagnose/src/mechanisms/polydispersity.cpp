#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Only structures of a recipe can be made again with sizes.
Mechanism polydispersity() {
    return {.name = "polydispersity",
            .term = "particles have a lognormal distribution of sizes; the structures are made with it",
            .signature = "the peak of the contacts is lower and wider, the pores change; coordination is kept",
            .parameters = {{"relative_size_deviation", "1", 0.02, 0.4, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.size_deviation = values[0]; }},
            .applies = sees_recipe};
}

}  // namespace coagula::diagnose::mechanisms
