// SPDX-License-Identifier: GPL-3.0-or-later
// Designs of a sweep: points of the unit cube at which the options take their values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::stages {

struct Design {
    enum class Kind { grid, latin_hypercube, sobol };

    Kind kind = Kind::grid;
    std::int64_t samples = 0;  ///< of a space-filling design
    std::uint64_t seed = 1;    ///< of a Latin hypercube
};

/// Points of a space-filling design, each with one coordinate from 0 to 1 for each of the dimensions. A Latin hypercube has one
/// point in each of as many equal layers as there are points along every axis (McKay, Beckman, Conover, Technometrics 21 (1979)
/// 239); the Sobol sequence begins at its second point (Joe and Kuo's direction numbers, as in Boost.Random).
std::vector<std::vector<double>> space_filling_points(const Design& design, std::size_t dimensions);

}  // namespace coagula::stages
