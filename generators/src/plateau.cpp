// SPDX-License-Identifier: GPL-3.0-or-later
#include "plateau.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coagula::generators {

bool is_plateau(const std::vector<double>& time, const std::vector<double>& values, double window, double change) {
    constexpr std::ptrdiff_t fewest = 4;
    if (time.empty() || time.back() - time.front() < window) {
        return false;
    }
    const auto place = [&](double before_end) {
        return values.begin() + (std::upper_bound(time.begin(), time.end(), time.back() - before_end) - time.begin());
    };
    const auto begin = place(window);
    const auto middle = place(0.5 * window);
    if (middle - begin < fewest || values.end() - middle < fewest) {
        return false;
    }
    const auto mean = [](auto first, auto last) { return std::accumulate(first, last, 0.0) / static_cast<double>(last - first); };
    const double later = mean(middle, values.end());
    return std::abs(later - mean(begin, middle)) < change * std::abs(later);
}

}  // namespace coagula::generators
