// SPDX-License-Identifier: GPL-3.0-or-later
// Whether coordinates and radii can be those of a packing of spheres: what a wrong length unit or pixel size makes of them cannot.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <string>
#include <vector>

namespace coagula::characterize {

/// Numbers that show at a glance whether spheres touch.
struct Plausibility {
    double volume_fraction = unset;  ///< overlaps are counted twice
    Index contacts = 0;              ///< pairs whose centres are nearer than 1.01 times the sum of their radii
    double coordination = 0;         ///< mean number of contacts per particle
    double smallest = unset;         ///< least distance of two centres over the sum of their radii; NaN for a single particle
    double median = unset;           ///< the same of a particle and its nearest, the median over the particles
    std::vector<std::string> warnings = {};  ///< a sentence for each value that no packing of spheres has
};

/// For each particle (N) the least distance of its centre to another, or to its own image, over the sum of both radii. Infinite for
/// a single particle in an open cell.
Eigen::VectorXd nearest_reduced_distances(const Packing& packing);

/// @param packing with at least one particle.
Plausibility judge_plausibility(const Packing& packing);

}  // namespace coagula::characterize
