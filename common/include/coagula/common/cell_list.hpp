// SPDX-License-Identifier: GPL-3.0-or-later
// Cell list: particles sorted into boxes no smaller than a cut-off, for neighbour searches in O(N).
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace coagula {

/// Particles sorted by box. A query point is compared with the particles of the boxes around it, through all periodic images
/// that come within the cut-off.
class CellList {
public:
    /// Sorts the columns of `positions` [m] into boxes as the cell is shaped, no narrower than the cut-off [m] (at most about two
    /// boxes per particle).
    CellList(const Cell& cell, const Eigen::Matrix3Xd& positions, double cutoff);

    /// Calls visit(particle, separation) for each particle image in the boxes around `point`; separation = image - point [m].
    /// All images nearer than the cut-off are among them; farther ones may be, too.
    template <class Visitor>
    void for_each_near(const Eigen::Vector3d& point, Visitor&& visit) const {
        const Eigen::Array3i home = box_of(point);
        for (int dz = -reach_[2]; dz <= reach_[2]; ++dz) {
            for (int dy = -reach_[1]; dy <= reach_[1]; ++dy) {
                for (int dx = -reach_[0]; dx <= reach_[0]; ++dx) {
                    visit_box(home + Eigen::Array3i(dx, dy, dz), point, visit);
                }
            }
        }
    }

    /// Particle ids in box order: a spatially coherent permutation.
    const std::vector<int>& order() const { return order_; }

private:
    Eigen::Array3i box_of(const Eigen::Vector3d& point) const;
    /// Of a box within the cell.
    std::size_t slot_of(const Eigen::Array3i& box) const {
        const Index slot = (static_cast<Index>(box[2]) * boxes_[1] + box[1]) * boxes_[0] + box[0];
        return static_cast<std::size_t>(slot);
    }

    template <class Visitor>
    void visit_box(Eigen::Array3i box, const Eigen::Vector3d& point, Visitor&& visit) const {
        Eigen::Vector3d shift = -point;
        for (int axis = 0; axis < 3; ++axis) {
            const int count = boxes_[axis];
            if (box[axis] >= 0 && box[axis] < count) {
                continue;
            }
            if (!cell_.is_periodic(axis)) {
                return;
            }
            const int turns = static_cast<int>(std::floor(static_cast<double>(box[axis]) / count));
            box[axis] -= turns * count;
            shift += turns * cell_.edges().col(axis);
        }
        const std::size_t slot = slot_of(box);
        for (int entry = start_[slot]; entry < start_[slot + 1]; ++entry) {
            const int particle = order_[static_cast<std::size_t>(entry)];
            visit(particle, Eigen::Vector3d(sorted_.col(entry) + shift));
        }
    }

    Cell cell_;
    Eigen::Array3i boxes_;     ///< number of boxes along each axis
    Eigen::Array3i reach_;     ///< how many boxes the cut-off spans
    std::vector<int> start_;   ///< first entry of each box, and the end
    std::vector<int> order_;   ///< particle of each entry
    Eigen::Matrix3Xd sorted_;  ///< wrapped positions in entry order [m]
};

}  // namespace coagula
