// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/logarithmic_steps.hpp>

#include <coagula/common/checks.hpp>

#include <cmath>
#include <string>

namespace coagula {

std::vector<double> logarithmic_steps(double from, double to, int count) {
    require_positive(from, "the first of logarithmic steps");
    require_positive(to, "the last of logarithmic steps");
    require(count >= 2, "the number of logarithmic steps is " + std::to_string(count) + ", but must be at least 2");
    std::vector<double> values;
    for (int k = 0; k + 1 < count; ++k) {
        values.push_back(from * std::pow(to / from, static_cast<double>(k) / (count - 1)));
    }
    values.push_back(to);
    return values;
}

}  // namespace coagula
