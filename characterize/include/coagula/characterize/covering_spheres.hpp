// SPDX-License-Identifier: GPL-3.0-or-later
// Pore sizes after Gelb and Gubbins: the largest sphere in the void that covers a point.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula::characterize {

struct CoveringOptions {
    Index points = 20000;  ///< random points in the box, of which those in the void count
    Index radii = 100;     ///< of the curve
    std::uint64_t seed = 1;
};

/// The pore-size distribution of Gelb and Gubbins, Langmuir 15 (1999) 305: the morphological opening of the void. The radius at a
/// point is never less than that of Torquato, which is the distance to the nearest surface.
struct CoveringSpheres {
    Eigen::VectorXd radius;            ///< r, equally spaced from 0 to the largest pore [m]
    Eigen::VectorXd exceeding;         ///< fraction of the points covered by a sphere of a radius above r
    Eigen::VectorXd exceeding_stderr;  ///< from sub-volumes, which includes the error of sampling; NaN if not known
    double mean = unset;               ///< [m]
    double mean_stderr = unset;
    double spread = unset;  ///< standard deviation [m]
    double spread_stderr = unset;
    double sampling_error = unset;  ///< part of the error of the mean that more points would take off [m]
    Index points = 0;               ///< that lay in the void
};

/// Spheres that have a point x on their surface and do not enter particle i have 1 / R >= (2 r_i + 2 q_i w) / (q_i^2 - r_i^2), q_i
/// being the way from x to the particle and w the direction from x to the centre of the sphere: 1 / R is the largest of functions
/// that are linear in w, and its minimum over the unit sphere is exact, by branch and bound. The largest sphere that has x inside
/// is that of a vertex of the Voronoi diagram. Equal spheres. In an open packing points count that lie two largest pores and a
/// radius inside the convex hull, and spheres no larger than the largest certain pore. Throws std::invalid_argument for unequal
/// spheres and if no point counts.
CoveringSpheres measure_covering_spheres(const Packing& packing, const CoveringOptions& options = {},
                                         const Progress& progress = {});

/// Radius of the largest empty sphere of at most `largest` that has the origin on its surface or is centred there [m]: the part of
/// the above that is left to branch and bound.
/// @param centres of particles seen from the point, 3 x P [m]: all with a surface nearer than 2 largest. @param radii P [m].
/// @param least radius that is known already [m]; returned if none is larger.
double largest_touching_sphere(const Eigen::Matrix3Xd& centres, const Eigen::VectorXd& radii, double largest, double least);

}  // namespace coagula::characterize
