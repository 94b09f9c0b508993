// Probabilities from logarithms that may be far apart, and the noise of drawn data.
#pragma once

#include <cstdint>
#include <vector>

namespace coagula::diagnose {

/// Logarithm of the sum of what these are the logarithms of.
double log_sum(const std::vector<double>& logarithms);

/// That of their mean.
double log_mean(const std::vector<double>& logarithms);

/// Probabilities in proportion to what these are the logarithms of.
std::vector<double> probabilities_of(std::vector<double> logarithms);

/// A standard normal number, the same for the same three numbers.
double normal_number(std::uint64_t seed, std::uint64_t step, std::uint64_t number);

}  // namespace coagula::diagnose
