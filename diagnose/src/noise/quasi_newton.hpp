// SPDX-License-Identifier: GPL-3.0-or-later
// Minimum of a smooth function of three deviations by a quasi-Newton method.
#pragma once

#include "restricted_likelihood.hpp"

#include <functional>

namespace coagula::diagnose {

/// Place of the minimum that the method finds from `start` on.
/// @param units of about the steps that count.
Deviations minimum_of(const std::function<double(const Deviations&)>& function, const Deviations& start, const Deviations& units);

}  // namespace coagula::diagnose
