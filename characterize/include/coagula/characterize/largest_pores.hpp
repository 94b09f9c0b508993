// SPDX-License-Identifier: GPL-3.0-or-later
// The largest pores as spheres: where they are and how large.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct LargestPoreOptions {
    Index count = 50;  ///< how many at most, > 0
};

/// Spheres in the void space, largest first. None overlaps another or a particle.
struct LargestPores {
    Eigen::Matrix3Xd centres;  ///< 3 x P [m], inside the cell when it is periodic
    Eigen::VectorXd radii;     ///< P [m]

    Index size() const { return radii.size(); }
};

/// Takes the spheres that touch the four particles of a Delaunay tetrahedron from outside, the largest first, and leaves out each
/// that overlaps one taken before (periodic images included). Equal particles: the first has the radius PoreSizes::max. Unequal
/// ones: the tetrahedra are those of the power diagram, and spheres that another particle enters are left out; the tetrahedra need
/// not be those of the largest empty spheres, so that a pore may be missed. In an open packing only tetrahedra of inner particles
/// count (inner_particles.hpp); there may be none. Throws std::invalid_argument for a packing that `check` refuses.
LargestPores find_largest_pores(const Packing& packing, const LargestPoreOptions& options = {});

}  // namespace coagula::characterize
