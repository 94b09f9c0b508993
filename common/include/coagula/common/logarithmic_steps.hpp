// SPDX-License-Identifier: GPL-3.0-or-later
// Values at equal ratios.
#pragma once

#include <vector>

namespace coagula {

/// `count` values from `from` to `to`, each the same multiple of the one before, rising or falling, ends included to the bit.
/// Throws std::invalid_argument unless both are finite and > 0 and count >= 2.
std::vector<double> logarithmic_steps(double from, double to, int count);

}  // namespace coagula
