// SPDX-License-Identifier: GPL-3.0-or-later
// Volume of the union of balls about the particles inside the counted cells of a diagram. Internal.
#pragma once

#include "geometry/power_diagram.hpp"

#include <coagula/characterize/blocks.hpp>
#include <coagula/common/progress.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::characterize {

/// Radii start, start + step, ..., `count` of them.
struct RadialGrid {
    double start = 0;
    double step = 0;
    Index count = 0;

    double operator[](Index k) const { return start + step * static_cast<double>(k); }
    /// The first k with a radius above x, at most `count`.
    Index first_above(double x) const {
        const double steps = std::floor((x - start) / step) + 1;
        return static_cast<Index>(std::clamp(steps, 0.0, static_cast<double>(count)));
    }
};

/// Covered volume and volume of the counted cells at each radius (rows), by block (columns).
struct Coverage {
    Eigen::MatrixXd covered;
    Eigen::MatrixXd cells;
};

/// Covered volume of equal spheres, for which one diagram serves all radii. The grid holds the radii of the balls, not their
/// growth.
/// @param blocks of the counted particles, at least one.
Coverage cover_equal_spheres(const PowerDiagram& diagram, const RadialGrid& ball_radii, const Blocks& blocks,
                             const Progress& progress);

/// Covered volume (row 0) and cell volume (row 1) for balls of the radii of the sites themselves, by block (columns).
Eigen::Matrix2Xd cover_spheres(const PowerDiagram& diagram, const Blocks& blocks);

}  // namespace coagula::characterize
