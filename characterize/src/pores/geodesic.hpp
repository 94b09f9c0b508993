// SPDX-License-Identifier: GPL-3.0-or-later
// Shortest paths through the pore space on a grid of voxels. Internal.
#pragma once

#include "voxel_pores.hpp"

namespace coagula::characterize {

/// Mean over the open voxels of the last layer along an axis of the shortest path from the plane before the first layer to the
/// plane after the last, over the length of the box. Infinite if there is no path. Fast marching with differences of second order
/// (Sethian, SIAM Review 41 (1999) 199), periodic across the axis.
/// @param distances surface_distances at the middle of the voxels.
double geodesic_tortuosity(const VoxelGrid& grid, const std::vector<double>& distances, int axis);

}  // namespace coagula::characterize
