// SPDX-License-Identifier: GPL-3.0-or-later
// When a time series has become level.
#pragma once

#include <vector>

namespace coagula::generators {

/// Whether the means of the values over the two halves of the last `window` of time differ by less than `change` times the later
/// one. Not as long as the series is shorter than the window or has fewer than four samples in each half.
bool is_plateau(const std::vector<double>& time, const std::vector<double>& values, double window, double change);

}  // namespace coagula::generators
