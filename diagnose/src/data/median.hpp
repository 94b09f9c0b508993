// SPDX-License-Identifier: GPL-3.0-or-later
// Median of a list of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace coagula::diagnose {

/// The middle number in order of size. Of an even number of values it is the upper of the two in the middle; of none it is 0.
inline double median(std::vector<double> values) {
    if (values.empty()) {
        return 0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace coagula::diagnose
