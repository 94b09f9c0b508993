// SPDX-License-Identifier: GPL-3.0-or-later
// Measurements that could be made next.
#pragma once

#include "chain/forward.hpp"

#include <string>
#include <vector>

namespace coagula::diagnose {

/// A measurement that could be made.
struct Candidate {
    std::string measurement;      ///< key, as in Proposal
    std::vector<double> lengths;  ///< gaps or radius [m]
    double rest = unset;          ///< between two sweeps [s]
    Experiment experiment;        ///< its tables, each on a fresh sample, whose moduli are still to be filled in
    std::vector<Observation> observations;
};

/// What of such measurements the experiment is about. Images: once more of the same particles, unless there are such. Moduli:
/// sweeps with the settings that the experiment has: its smallest strain, its typical frequency, its longest time; between plates
/// one under a cone; and where the gap is known a smaller plate and series of gaps, from wide to narrow unless the experiment has
/// such, also between rough plates and with an oil. Steady flow: flow curves over the same shear rates, up and down, with a smaller
/// tool and at a smaller gap.
std::vector<Candidate> candidates_for(const Experiment& experiment, const std::vector<Observation>& observations);

}  // namespace coagula::diagnose
