// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxel_pores.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::characterize {

namespace {

int wrapped(int place, int count) {
    const int rest = place % count;
    return rest < 0 ? rest + count : rest;
}

/// Fraction of a triangle where the linear function with these values at the corners is positive.
double positive_fraction(double a, double b, double c) {
    const int positive = (a > 0 ? 1 : 0) + (b > 0 ? 1 : 0) + (c > 0 ? 1 : 0);
    if (positive == 0 || positive == 3) {
        return positive == 3 ? 1 : 0;
    }
    const bool lonely = positive == 1;  // whether the corner that differs from the others is the positive one
    if ((b > 0) == lonely && (a > 0) != lonely && (c > 0) != lonely) {
        std::swap(a, b);
    } else if ((c > 0) == lonely && (a > 0) != lonely && (b > 0) != lonely) {
        std::swap(a, c);
    }
    const double corner = a / (a - b) * (a / (a - c));
    return lonely ? corner : 1 - corner;
}

/// Part of a square where a value is positive that is known at the corners. Four triangles that meet in the middle make the square.
double open_fraction(double a, double b, double c, double d) {
    if (a > 0 && b > 0 && c > 0 && d > 0) {
        return 1;
    }
    if (a <= 0 && b <= 0 && c <= 0 && d <= 0) {
        return 0;
    }
    const double middle = (a + b + c + d) / 4;
    return (positive_fraction(a, b, middle) + positive_fraction(b, c, middle) + positive_fraction(c, d, middle) +
            positive_fraction(d, a, middle)) /
           4;
}

}  // namespace

VoxelGrid make_grid(const Packing& packing, double edge) {
    constexpr double large = 48;
    VoxelGrid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const double wanted = packing.cell.lengths()[axis] / edge;
        const double multiple = wanted > large ? 8 : 2;
        grid.count[axis] = static_cast<int>(multiple * std::max(1.0, std::round(wanted / multiple)));
    }
    grid.edge = packing.cell.lengths().array() / grid.count.cast<double>();
    return grid;
}

std::vector<double> surface_distances(const Packing& packing, const VoxelGrid& grid, double offset) {
    const double reach = 3 * grid.edge.maxCoeff();
    std::vector<double> distance(static_cast<std::size_t>(grid.voxels()), reach);
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Array3d centre = packing.cell.wrap(packing.positions.col(i)) - packing.cell.origin();
        const double radius = packing.radii[i];
        const Eigen::Array3i low = ((centre - radius - reach) / grid.edge - offset).ceil().cast<int>();
        const Eigen::Array3i high = ((centre + radius + reach) / grid.edge - offset).floor().cast<int>();
        for (int z = low[2]; z <= high[2]; ++z) {
            const double dz = (z + offset) * grid.edge[2] - centre[2];
            for (int y = low[1]; y <= high[1]; ++y) {
                const double dy = (y + offset) * grid.edge[1] - centre[1];
                const Index row = grid.number(0, wrapped(y, grid.count[1]), wrapped(z, grid.count[2]));
                for (int x = low[0]; x <= high[0]; ++x) {
                    const double dx = (x + offset) * grid.edge[0] - centre[0];
                    double& least = distance[static_cast<std::size_t>(row + wrapped(x, grid.count[0]))];
                    const double squared = dx * dx + dy * dy + dz * dz;
                    if (squared < (least + radius) * (least + radius)) {  // spares most of the roots
                        least = std::min(least, std::sqrt(squared) - radius);
                    }
                }
            }
        }
    }
    return distance;
}

OpenFaces open_faces(const VoxelGrid& grid, const std::vector<double>& corners, double growth) {
    OpenFaces faces;
    for (auto& face : faces) {
        face.resize(corners.size());
    }
    const Eigen::Array3i& n = grid.count;
#pragma omp parallel for schedule(static)
    for (int z = 0; z < n[2]; ++z) {
        for (int y = 0; y < n[1]; ++y) {
            const int next_y = y + 1 == n[1] ? 0 : y + 1;
            const int next_z = z + 1 == n[2] ? 0 : z + 1;
            const std::array<const double*, 4> row = {&corners[static_cast<std::size_t>(grid.number(0, y, z))],
                                                      &corners[static_cast<std::size_t>(grid.number(0, next_y, z))],
                                                      &corners[static_cast<std::size_t>(grid.number(0, y, next_z))],
                                                      &corners[static_cast<std::size_t>(grid.number(0, next_y, next_z))]};
            for (int x = 0; x < n[0]; ++x) {
                const int next_x = x + 1 == n[0] ? 0 : x + 1;
                const auto at = [&](int dx, int dy, int dz) {
                    const int number = dy + 2 * dz;
                    return row[static_cast<std::size_t>(number)][dx == 0 ? x : next_x] - growth;
                };
                const auto voxel = static_cast<std::size_t>(grid.number(x, y, z));
                const double far = at(1, 1, 1);
                faces[0][voxel] = open_fraction(at(1, 0, 0), at(1, 1, 0), far, at(1, 0, 1));
                faces[1][voxel] = open_fraction(at(0, 1, 0), at(1, 1, 0), far, at(0, 1, 1));
                faces[2][voxel] = open_fraction(at(0, 0, 1), at(1, 0, 1), far, at(0, 1, 1));
            }
        }
    }
    return faces;
}

}  // namespace coagula::characterize
