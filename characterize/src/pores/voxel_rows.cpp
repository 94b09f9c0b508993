// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxel_rows.hpp"

#include <coagula/common/vector_variants.hpp>

namespace coagula::characterize {

namespace {

template <int step>
COAGULA_INLINE void sum_every(const VoxelRow& row, int first, float* __restrict sum) {
    const float *gx = row.gx, *gy = row.gy, *gy_front = row.gy_front, *gz = row.gz, *gz_below = row.gz_below;
    const float *here = row.here, *front = row.front, *back = row.back, *below = row.below, *above = row.above;
    const int last = row.count - 1;
    for (int x = first; x <= last; x += step) {
        sum[x] = (gy_front[x] * front[x] + gy[x] * back[x]) + (gz_below[x] * below[x] + gz[x] * above[x]);
    }
    for (int x = first == 0 ? step : first; x < last; x += step) {
        sum[x] += gx[x - 1] * here[x - 1] + gx[x] * here[x + 1];
    }
    if (first == 0) {
        sum[0] += gx[last] * here[last] + gx[0] * here[1];
    }
    if ((last - first) % step == 0) {
        sum[last] += gx[last - 1] * here[last - 1] + gx[last] * here[0];
    }
}

}  // namespace

COAGULA_VARIANTS void sum_neighbours(const VoxelRow& row, float* sum) {
    sum_every<1>(row, 0, sum);
}

COAGULA_VARIANTS void sum_neighbours_of_colour(const VoxelRow& row, int first, float* sum) {
    sum_every<2>(row, first, sum);
}

double row_power(const VoxelRow& row, const std::array<double, 3>& applied) {
    double sum = 0;
    for (int x = 0; x < row.count; ++x) {
        const double here = row.here[x];
        const double dx = row.here[x + 1 == row.count ? 0 : x + 1] - here + applied[0];
        const double dy = row.back[x] - here + applied[1];
        const double dz = row.above[x] - here + applied[2];
        sum += row.gx[x] * dx * dx + row.gy[x] * dy * dy + row.gz[x] * dz * dz;
    }
    return sum;
}

}  // namespace coagula::characterize
