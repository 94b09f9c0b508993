// SPDX-License-Identifier: GPL-3.0-or-later
// The part of an open packing that its free surface does not touch.
#pragma once

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

/// For each particle (N), whether its Voronoi (power) cell is certain: whatever lies outside the convex hull of the given centres
/// could not change it, if no sphere there is larger than the largest given. True for all particles of a periodic packing; possibly
/// for none of a small open one.
std::vector<bool> inner_particles(const Packing& packing);

/// How an open packing is strained: by the particles at its free surface, with the stress averaged over the cells of the others.
struct FreeSurface {
    std::vector<bool> outer;  ///< N flags: not among the inner particles
    double inner_volume;      ///< of the cells of the inner particles [m^3]
};

FreeSurface free_surface(const Packing& packing);

}  // namespace coagula::characterize
