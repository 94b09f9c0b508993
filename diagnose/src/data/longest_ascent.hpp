// SPDX-License-Identifier: GPL-3.0-or-later
// The order of the values of an axis.
#pragma once

#include <cstddef>
#include <vector>

namespace coagula::diagnose {

/// Positions of a longest strictly ascending subsequence of the finite values.
std::vector<std::size_t> longest_ascent(const std::vector<double>& values);

}  // namespace coagula::diagnose
