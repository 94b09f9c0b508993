// SPDX-License-Identifier: GPL-3.0-or-later
// Search for the measurement that would separate tied causes.
#pragma once

#include "hypothesis.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Candidate measurements ranked by expected information gain between the causes (Lindley 1956), by drawing data from each cause's
/// posterior and asking which cause they would point to. Errors are those of the data so far, on a fresh sample; what few
/// structures leave open about a prediction is as open as the data so far leave it, so that measuring the same once more says
/// nothing about it.
/// @param weights posterior of each fit; need not sum to 1.
std::vector<Proposal> propose(const Inference& inference, Simulator& simulator, const std::vector<Fit>& causes,
                              const std::vector<double>& weights, std::uint64_t seed);

}  // namespace coagula::diagnose
