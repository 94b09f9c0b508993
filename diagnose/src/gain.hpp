// What an extended model gains on data that it has not seen.
#pragma once

#include "hypothesis.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Which observations are held out: the last table of every kind that has at least two with different samples, else the rows at the
/// end of the axis of every table.
std::vector<bool> choose_held_out(const Experiment& experiment, const std::vector<Observation>& observations, double part);

/// Fits base and extended model to the other observations and compares their predictions of those held out.
Gain measure_gain(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment, Simulator& simulator,
                  const Hypothesis& extended, std::uint64_t seed);

}  // namespace coagula::diagnose
