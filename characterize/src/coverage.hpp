// Volume of the union of balls about the particles inside the counted cells of a diagram. Internal.
#pragma once

#include "power_diagram.hpp"

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

/// Covered volume and volume of the counted cells at each radius.
struct Coverage {
    Eigen::VectorXd covered;
    Eigen::VectorXd cells;
};

/// For equal spheres one diagram serves all radii. The grid holds the radii of the balls (not their growth).
Coverage cover_equal_spheres(const PowerDiagram& diagram, const RadialGrid& ball_radii, const Progress& progress);

/// Covered volume and cell volume for balls of the radii of the sites themselves.
std::array<double, 2> cover_spheres(const PowerDiagram& diagram);

}  // namespace coagula::characterize
