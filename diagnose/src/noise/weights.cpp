#include "weights.hpp"

#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

double log_sum(const std::vector<double>& logarithms) {
    const double largest = *std::max_element(logarithms.begin(), logarithms.end());
    double sum = 0;
    for (const double value : logarithms) {
        sum += std::exp(value - largest);
    }
    return largest + std::log(sum);
}

double log_mean(const std::vector<double>& logarithms) {
    return log_sum(logarithms) - std::log(static_cast<double>(logarithms.size()));
}

std::vector<double> probabilities_of(std::vector<double> logarithms) {
    const double total = log_sum(logarithms);
    for (double& value : logarithms) {
        value = std::exp(value - total);
    }
    return logarithms;
}

double normal_number(std::uint64_t seed, std::uint64_t step, std::uint64_t number) {
    const auto u = random_uniform(seed, RandomPurpose::diagnosis, step, number);
    return std::sqrt(-2 * std::log(1 - u[0])) * std::cos(2 * std::numbers::pi * u[1]);
}

}  // namespace coagula::diagnose
