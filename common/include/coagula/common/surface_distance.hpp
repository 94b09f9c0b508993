// SPDX-License-Identifier: GPL-3.0-or-later
// Distance from a point to the particles about it.
#pragma once

#include <coagula/common/cell_list.hpp>
#include <coagula/common/packing.hpp>

#include <algorithm>
#include <limits>

namespace coagula {

/// Distance from a point to the nearest particle surface [m], negative inside a particle; infinite if beyond the reach of the list.
/// @param cells of this packing.
inline double surface_distance(const CellList& cells, const Packing& packing, const Eigen::Vector3d& point) {
    double nearest = std::numeric_limits<double>::infinity();
    cells.for_each_near(point, [&](int particle, const Eigen::Vector3d& separation) {
        nearest = std::min(nearest, separation.norm() - packing.radii[particle]);
    });
    return nearest;
}

}  // namespace coagula
