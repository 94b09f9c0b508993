// SPDX-License-Identifier: GPL-3.0-or-later
// Pore sizes: the probability that a random point of the void space is farther than r from the nearest particle surface,
// exact, from the volume of the union of balls cut up along the Voronoi (power) cells.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula::characterize {

struct PoreOptions {
    Index radii = 200;        ///< number of equally spaced radii from 0 to the largest pore, >= 4
    double tolerance = 5e-5;  ///< of P by interpolation between radii, for unequal spheres; 0: every radius is computed
};

/// The pore-size curve and its moments. Lengths in metres.
struct PoreSizes {
    Eigen::VectorXd radius;                 ///< r, equally spaced from 0 to `max` [m]
    Eigen::VectorXd exclusion_probability;  ///< P(r_P > r); 1 at r = 0, 0 at r = max
    double mean = unset;                    ///< of the pore radius r_P [m]
    double second_moment = unset;           ///< mean of r_P^2 [m^2]
    double median = unset;                  ///< [m]
    double max = unset;                     ///< radius of the largest pore [m]
    double void_fraction = unset;           ///< 1 - volume of the union of the spheres / volume measured
    double volume = unset;                  ///< volume measured: the periodic cell, or the inner cells of an open packing [m^3]
    Index inner_particles = 0;              ///< particles whose Voronoi cells were measured (all, if periodic)
    double cell_volume_defect = unset;      ///< |sum of the cell volumes / volume - 1|, a check of the geometry; unset if open
    double curve_error = 0;                 ///< estimate of the largest error of P by interpolation; 0 for equal spheres
    Eigen::MatrixXd void_by_block;          ///< [radius][block]: volume farther than r from every surface, by sub-volume [m^3]
    Eigen::MatrixXd volume_by_block;        ///< [radius][block]: volume of the cells [m^3]; one block if none were given
};

/// Exact curve. Periodic cells of any orthorhombic shape. In an open packing only particles count whose Voronoi cell no particle
/// outside the convex hull of the given centres could change (inner_particles.hpp); std::invalid_argument if there are none, or no
/// void. Equal spheres need one triangulation for all radii. Unequal ones need one per radius, because the power cells move as the
/// balls grow: the curve is computed at 33 radii or more and interpolated, until P is right within the tolerance (curve_error says
/// to how much). In an open packing the measured volume then moves too, and P is normalised at each radius. Moments are accurate to
/// 1e-6 for equal spheres, the median to 1e-5.
PoreSizes measure_pores(const Packing& packing, const PoreOptions& options = {}, const Progress& progress = {});

/// Exclusion probability at the given radii [m] estimated from random points of the void space: a check of the exact curve.
/// Periodic packings. Standard error sqrt(P (1 - P) / points in the void).
struct SampledPores {
    Eigen::VectorXd exclusion_probability;  ///< as many as radii
    Index void_points = 0;                  ///< sample points that fell into the void space
};
SampledPores sample_pores(const Packing& packing, const Eigen::VectorXd& radius, Index points, std::uint64_t seed);

/// The sampled curve held against the exact one.
struct SampledCheck {
    SampledPores sampled;
    /// (sampled - exact) / standard error, largest absolute value over the radii where the binomial distribution is close to a
    /// normal one (expected P (1 - P) n >= 25).
    double largest_z = unset;
    Index radii = 0;  ///< that were compared
};
SampledCheck compare_with_samples(const Packing& packing, const PoreSizes& exact, Index points, std::uint64_t seed);

}  // namespace coagula::characterize
