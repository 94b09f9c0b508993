// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include <coagula/diagnose/simulator.hpp>

#include <set>

namespace coagula::diagnose::mechanisms {

namespace {

bool compares_sizes(const Knows& knows) {
    const std::set<std::size_t> sizes(knows.experiment.structure_sizes.begin(), knows.experiment.structure_sizes.end());
    return sizes.size() > 1 && !knows.experiment.structure_groups.empty();
}

}  // namespace

Mechanism numerical() {
    return {
        .name = "numerical",
        .term = "the simulated structures are too small: the modulus drifts with their number of particles",
        .signature =
            "The smaller the simulated structures are, the more the measured moduli deviate from theirs. With "
            "larger structures the deviation vanishes.",
        .kind = {Link::errors, Axis::level},
        .parameters = {{"drift_at_thousand_particles", "1", -0.3, 1, false}},
        .effect = ScalesMaterial{[](const Observation& row, Values values, const SimulatedSample& sample) -> std::complex<double> {
            return 1 + values[0] * std::cbrt(1000 / sample.simulator.particles(row.structures));
        }},
        .applies = compares_sizes};
}

}  // namespace coagula::diagnose::mechanisms
