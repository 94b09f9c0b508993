// SPDX-License-Identifier: GPL-3.0-or-later
// The pore space of a periodic packing on a grid of voxels. Internal.
#pragma once

#include <coagula/common/packing.hpp>

#include <array>
#include <vector>

namespace coagula::characterize {

/// A periodic grid. Voxel (x, y, z) has the number (z ny + y) nx + x.
struct VoxelGrid {
    Eigen::Array3i count;
    Eigen::Array3d edge;  ///< of a voxel [m]

    Index voxels() const { return static_cast<Index>(count[0]) * count[1] * count[2]; }
    Index number(int x, int y, int z) const { return (static_cast<Index>(z) * count[1] + y) * count[0] + x; }
};

/// Voxels about `edge` wide; their number along each axis is even, and a multiple of 8 where it is more than 48, so
/// that coarser grids can be made.
VoxelGrid make_grid(const Packing& packing, double edge);

/// Distance to the nearest surface at one point of each voxel, negative inside spheres; only right within three voxels of a
/// surface, farther away at least that. @param offset of the point from the voxel's lower corner, in edges.
std::vector<double> surface_distances(const Packing& packing, const VoxelGrid& grid, double offset);

/// Open fraction of the face between each voxel and the next along each axis, from the distances at its corners by linear
/// interpolation. @param corners surface_distances with offset 0. @param growth added to the radii of all spheres.
using OpenFaces = std::array<std::vector<double>, 3>;
OpenFaces open_faces(const VoxelGrid& grid, const std::vector<double>& corners, double growth = 0);

}  // namespace coagula::characterize
