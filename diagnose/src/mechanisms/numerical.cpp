#include "mechanisms.hpp"

#include <set>

namespace coagula::diagnose::mechanisms {

namespace {

bool compares_sizes(const Experiment& experiment) {
    const std::set<std::size_t> sizes(experiment.structure_sizes.begin(), experiment.structure_sizes.end());
    return sizes.size() > 1 && !experiment.structure_groups.empty();
}

}  // namespace

Mechanism numerical() {
    return {.name = "numerical",
            .term = "the simulated structures are too small: the modulus drifts with their number of particles",
            .signature =
                "what is measured departs from the simulation the more the fewer particles the structure has; gone after "
                "refinement",
            .parameters = {{"drift_at_thousand_particles", "1", -0.3, 1, false, &Settings::size_drift}},
            .in_contact = false,
            .applies = compares_sizes};
}

}  // namespace coagula::diagnose::mechanisms
