// SPDX-License-Identifier: GPL-3.0-or-later
#include "longest_ascent.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

std::vector<std::size_t> longest_ascent(const std::vector<double>& values) {
    std::vector<std::size_t> tails;  // last position of the best ascent of each length
    std::vector<std::ptrdiff_t> before(values.size(), -1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            continue;
        }
        const auto place =
            std::lower_bound(tails.begin(), tails.end(), i, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
        if (place != tails.begin()) {
            before[i] = static_cast<std::ptrdiff_t>(*(place - 1));
        }
        place == tails.end() ? tails.push_back(i) : void(*place = i);
    }
    std::vector<std::size_t> ascent;
    for (std::ptrdiff_t i = tails.empty() ? -1 : static_cast<std::ptrdiff_t>(tails.back()); i >= 0;
         i = before[static_cast<std::size_t>(i)]) {
        ascent.push_back(static_cast<std::size_t>(i));
    }
    return ascent;
}

}  // namespace coagula::diagnose
