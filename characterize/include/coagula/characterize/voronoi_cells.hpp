// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi (power) cells of the particles: volumes, faces, and the distribution of the volumes.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

/// Volumes of the cells; of the power diagram, if the spheres are unequal.
struct VoronoiCells {
    Eigen::VectorXd volumes;    ///< N [m^3]; 0 for particles whose cell is swallowed, or is not certain in an open packing
    std::vector<bool> certain;  ///< N: all of a periodic packing, the inner ones of an open one (inner_particles.hpp)
};
VoronoiCells measure_voronoi_cells(const Packing& packing);

/// The faces between the cells, each once; those of an open packing that bound an inner cell.
struct VoronoiFaces {
    ContactNetwork neighbours;  ///< particles on either side, and the vector between their centres
    Eigen::VectorXd areas;      ///< M [m^2]
};
VoronoiFaces measure_voronoi_faces(const Packing& packing);

/// Smallest Voronoi cell that equal spheres can have without overlap, over r^3: the dodecahedron around a sphere (Hales,
/// McLaughlin, J. Am. Math. Soc. 23 (2010) 299).
inline constexpr double smallest_voronoi_volume = 5.550291028515511;

/// A distribution of x narrower than this has no gamma law: k would be above a million. Coordinates of seven digits alone make the
/// cells of a perfect crystal differ by some 1e-5 of their free volume.
inline constexpr double narrowest_gamma_law = 1e-3;

/// The distribution of x = (V - V_min) / (mean V - V_min), the free volume of a cell over its mean, with the gamma law
/// f(x) = k^k / Gamma(k) x^(k-1) exp(-k x) of Aste and Di Matteo, Phys. Rev. E 77 (2008) 021309. Equal spheres.
struct VoronoiDistribution {
    double mean = unset;       ///< of the volumes [m^3]
    double deviation = unset;  ///< standard deviation of the volumes [m^3]
    double width = unset;      ///< standard deviation of x: 1 / sqrt(k) of the moments; larger is more heterogeneous
    double shape = unset;      ///< k of largest likelihood; NaN if `width` is below narrowest_gamma_law, or a cell below V_min
    double distance = unset;   ///< largest difference between the distribution and the fitted one (Kolmogorov)
    Index cells = 0;
};
/// k of largest likelihood of a gamma law with mean 1, from minus the mean of log x.
double gamma_shape(double minus_mean_log);

/// @param volumes of the cells [m^3]. @param radius of the spheres [m].
VoronoiDistribution fit_voronoi_volumes(const Eigen::VectorXd& volumes, double radius);

}  // namespace coagula::characterize
