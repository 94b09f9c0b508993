// The part of an open packing that its free surface does not touch.
#pragma once

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

/// For each particle (N), whether its Voronoi (power) cell is certain: whatever lies outside the convex hull of the given centres
/// could not change it, if no sphere there is larger than the largest given. True for all particles of a periodic packing; possibly
/// for none of a small open one.
std::vector<bool> inner_particles(const Packing& packing);

}  // namespace coagula::characterize
