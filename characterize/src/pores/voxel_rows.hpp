// SPDX-License-Identifier: GPL-3.0-or-later
// Arithmetic on rows of voxels, in loops that the compiler turns into vector instructions. Internal.
#pragma once

#include <array>

namespace coagula::characterize {

/// A row of voxels along x, with the rows beside it along y and z. Conductances lead to the next voxel along their axis.
struct VoxelRow {
    int count = 0;
    const float *gx = nullptr, *gy = nullptr, *gy_front = nullptr, *gz = nullptr, *gz_below = nullptr;
    const float *here = nullptr, *front = nullptr, *back = nullptr, *below = nullptr, *above = nullptr;
};

/// sum[x] = conductance times value, over the six neighbours of each voxel.
void sum_neighbours(const VoxelRow& row, float* sum);

/// Sums the neighbours of every second voxel, from `first` (0 or 1) on; the other sums are left as they are.
void sum_neighbours_of_colour(const VoxelRow& row, int first, float* sum);

/// Sum of g drop^2 over the faces to the next voxels, with `applied` added to the drops along x, y, z.
double row_power(const VoxelRow& row, const std::array<double, 3>& applied);

}  // namespace coagula::characterize
