// SPDX-License-Identifier: GPL-3.0-or-later
// From the noise of replicates to the errors of every modulus of an experiment.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/noise.hpp>

#include <vector>

namespace coagula::diagnose {

/// Gives every modulus without a standard error that of the noise model of its kind, and the shape of its errors.
void state_errors(Experiment& experiment, const std::vector<NoiseModel>& noise);

/// Standard deviation of the sample effect and its degrees of freedom. Models of the same samples tell the same effects; a stated
/// one counts as one degree.
void state_sample_effect(const std::vector<NoiseModel>& noise, double stated, NoiseSettings& settings);

}  // namespace coagula::diagnose
