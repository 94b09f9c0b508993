// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout.hpp"

#include <limits>

namespace coagula::io::layout {

Eigen::Matrix3Xd stored_positions(const Packing& packing) {
    const Cell& cell = packing.cell;
    if (cell.is_open()) {
        return packing.positions * nanometres;
    }
    const Eigen::Vector3d lower = cell.origin() * nanometres;
    Eigen::Vector3d upper = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    for (int axis = 0; axis < 3; ++axis) {
        if (cell.is_rectangular() && cell.is_periodic(axis)) {
            upper[axis] = (cell.origin()[axis] + cell.edges()(axis, axis)) * nanometres;
        }
    }
    Eigen::Matrix3Xd stored(3, packing.size());
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d position = cell.wrap(packing.positions.col(particle)) * nanometres;
        stored.col(particle) = (position.array() < upper.array()).select(position, lower);
    }
    return stored;
}

}  // namespace coagula::io::layout
