// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/log_probability.hpp>

#include <algorithm>
#include <cmath>

namespace coagula {

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

}  // namespace coagula
