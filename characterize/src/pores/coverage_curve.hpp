// SPDX-License-Identifier: GPL-3.0-or-later
// Covered volume against the growth of the radii. Internal; lengths in units of the mean radius.
#pragma once

#include "coverage.hpp"
#include "geometry/reduced_diagram.hpp"

namespace coagula::characterize {

/// Coverage at equally spaced growths of the radii from 0 to the largest pore, intervals + 1 of them.
struct CoverageCurve {
    double largest = 0;  ///< radius of the largest pore
    Coverage coverage;
    double error = 0;  ///< estimate of the largest error of P by interpolation; 0: every radius was computed
};

/// Radius of the largest pore alone.
double largest_pore(const ReducedDiagram& reduced);

/// Throws std::invalid_argument when the spheres cover all space.
/// @param tolerance of P by interpolation, for unequal spheres; 0: no interpolation.
CoverageCurve cover_curve(const ReducedDiagram& reduced, Index intervals, double tolerance, const Blocks& blocks,
                          const Progress& progress);

}  // namespace coagula::characterize
