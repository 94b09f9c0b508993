// Which further measurement would tell tied causes apart.
#pragma once

#include "hypothesis.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Candidate measurements ranked by expected information gain between the causes (Lindley 1956), by drawing data from each cause's
/// posterior and asking which cause they would point to.
/// Errors are those of the data so far, on a fresh sample.
/// @param weights posterior of each fit; need not sum to 1.
std::vector<Proposal> propose(const Experiment& experiment, const DataSet& data, Simulator& simulator,
                              const std::vector<Fit>& causes, const std::vector<double>& weights, std::uint64_t seed);

}  // namespace coagula::diagnose
