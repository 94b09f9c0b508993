// SPDX-License-Identifier: GPL-3.0-or-later
// Pores as the spheres between four neighbours, and the throats between these.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

/// Sums of what follows over the tetrahedra and triangles of the Delaunay tessellation, shared out among their particles.
/// Rows: 1; volume V of the tetrahedra, V R, V R^2; number T of throats, T t, T t^2. R: radius of the sphere that touches the four
/// particles of a tetrahedron; t: of the sphere that touches three with its centre in their plane. Lengths in metres.
struct DelaunayPores {
    Eigen::Matrix<double, 7, Eigen::Dynamic> by_particle;  ///< 7 x N
    Eigen::VectorXd radius;                                ///< r, equally spaced from 0 to the largest R [m]
    Eigen::VectorXd circumspheres;                         ///< fraction of the volume of the tetrahedra with R > r
    Eigen::VectorXd throats;                               ///< fraction of the throats with t > r
};

/// Equal spheres; of an open packing the tetrahedra and triangles of the inner particles. A triangle has a throat if the way
/// through it is narrower there than on either side. In a perfect lattice five or more particles on a sphere can be cut into
/// tetrahedra in several ways, and a throat between four particles counts several times. Throws std::invalid_argument for unequal
/// spheres, whose tetrahedra are not those of the touching spheres.
DelaunayPores measure_delaunay_pores(const Packing& packing, Index radii = 100);

}  // namespace coagula::characterize
