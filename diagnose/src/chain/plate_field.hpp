// SPDX-License-Identifier: GPL-3.0-or-later
// Means over a pair of parallel plates of what depends on the local strain.
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace coagula::diagnose {

/// A ring of the plates.
struct Ring {
    double radius;  ///< over that of the plates: also its strain over that at the rim
    double weight;  ///< its share of the torque of a linear sample; the sum over the rings is 1
};

/// Rings for 4 / R^4 times integrals over r^3 dr, that is over s = (r / R)^4 from 0 to 1: Gauss and Legendre's three nodes in each
/// of some equal panels of s.
inline std::vector<Ring> plate_rings(int panels) {
    const double outer = std::sqrt(0.6);
    constexpr double end = 5.0 / 18;
    std::vector<Ring> rings;
    for (int panel = 0; panel < panels; ++panel) {
        for (const auto& [node, weight] : {std::array{-outer, end}, std::array{0.0, 1 - 2 * end}, std::array{outer, end}}) {
            rings.push_back({std::pow((panel + 0.5 * (1 + node)) / panels, 0.25), weight / panels});
        }
    }
    return rings;
}

}  // namespace coagula::diagnose
