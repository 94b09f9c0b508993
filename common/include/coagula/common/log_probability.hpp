// SPDX-License-Identifier: GPL-3.0-or-later
// Probabilities from logarithms that may be far apart.
#pragma once

#include <vector>

namespace coagula {

/// Logarithm of the sum of what these are the logarithms of.
double log_sum(const std::vector<double>& logarithms);

/// Logarithm of the mean of what these are the logarithms of.
double log_mean(const std::vector<double>& logarithms);

/// Probabilities in proportion to what these are the logarithms of.
std::vector<double> probabilities_of(std::vector<double> logarithms);

}  // namespace coagula
