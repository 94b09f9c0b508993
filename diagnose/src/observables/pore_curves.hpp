// SPDX-License-Identifier: GPL-3.0-or-later
// Pore curves: what a table of them says, with its errors.
#pragma once

#include "observations.hpp"

#include <vector>

namespace coagula::diagnose {

/// The rows of a table of kind pore-curve with a probability between 0.01 and 1, ends excluded: at r = 0 all structures agree, and
/// beyond 0.01 one largest pore decides. Needs the particle radius.
///
/// Standard errors that are not stated are those of a curve sampled in a hundred thousand points.
std::vector<Observation> pores_in(const Experiment& experiment, std::size_t number);

}  // namespace coagula::diagnose
