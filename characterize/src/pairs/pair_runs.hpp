// SPDX-License-Identifier: GPL-3.0-or-later
// All pairs of a packing that are nearer than a range, met in contiguous runs of coordinates that a compiler can vectorise.
// Internal. For ranges of many particles, where a list of the pairs would not fit into memory.
#pragma once

#include <coagula/common/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace coagula::characterize {

/// Particles sorted into boxes of about a quarter of the range. An entry is a particle in box order.
class PairRuns {
public:
    /// @param packing in a reduced cell. @param range [m]; at most half the period of its cell, so that no pair is met through two
    /// images.
    PairRuns(const Packing& packing, double range);

    Index rows() const { return static_cast<Index>(boxes_[1]) * boxes_[2]; }

    /// Calls visit(entry, begin, end, shift) so that all pairs (entry, e in [begin, end)) of all rows are each pair once. Every
    /// pair within the range is among them, with the separation position(e) + shift - position(entry); farther ones may be, too.
    template <class Visitor>
    void for_each_run(Index row, Visitor&& visit) const {
        const Eigen::Array3i home(0, static_cast<int>(row % boxes_[1]), static_cast<int>(row / boxes_[1]));
        for (int dz = 0; dz <= reach_[2]; ++dz) {
            for (int dy = dz == 0 ? 0 : -reach_[1]; dy <= reach_[1]; ++dy) {
                visit_row(home, dy, dz, visit);
            }
        }
    }

    std::vector<double> x, y, z;         ///< of the entries, wrapped into the cell [m]
    std::vector<std::int32_t> particle;  ///< of the entries

private:
    /// The boxes of one row (dy, dz) that come within range of each box of the home row.
    template <class Visitor>
    void visit_row(const Eigen::Array3i& home, int dy, int dz, Visitor&& visit) const {
        Eigen::Array3i row(0, home[1] + dy, home[2] + dz);
        Eigen::Vector3d shift = Eigen::Vector3d::Zero();
        if (!wrap(row, shift, 1) || !wrap(row, shift, 2)) {
            return;
        }
        const double gap_y = std::max(0, std::abs(dy) - 1) * edge_[1];
        const double gap_z = std::max(0, std::abs(dz) - 1) * edge_[2];
        const double gap = std::max(gap_y, gap_z);  // between planes; only at right angles do the gaps add up
        const double left = range_ * range_ - (cell_.is_rectangular() ? gap_y * gap_y + gap_z * gap_z : gap * gap);
        if (left <= 0) {
            return;
        }
        const int near = cell_.is_rectangular() ? static_cast<int>(std::sqrt(left) / edge_[0]) + 1 : reach_[0];
        const int reach = std::min(reach_[0], near);
        const bool own = dy == 0 && dz == 0;
        for (int box = 0; box < boxes_[0]; ++box) {
            const std::size_t slot = slot_of(box, home[1], home[2]);
            for (Index entry = start_[slot]; entry < start_[slot + 1]; ++entry) {
                if (own) {
                    visit(entry, entry + 1, start_[slot + 1], shift);
                }
                visit_boxes(entry, own ? box + 1 : box - reach, box + reach, row, shift, visit);
            }
        }
    }

    /// Boxes first to last along x, of which those outside the cell are images.
    template <class Visitor>
    void visit_boxes(Index entry, int first, int last, const Eigen::Array3i& row, const Eigen::Vector3d& shift,
                     Visitor&& visit) const {
        const int count = boxes_[0];
        while (first <= last) {
            const int turn = first < 0 ? -1 : (first >= count ? 1 : 0);
            const int end = std::min(last, (turn + 1) * count - 1);
            if (turn == 0 || cell_.is_periodic(0)) {
                const Eigen::Vector3d moved = shift + turn * cell_.edges().col(0);
                visit(entry, start_[slot_of(first - turn * count, row[1], row[2])],
                      start_[slot_of(end - turn * count, row[1], row[2]) + 1], moved);
            }
            first = end + 1;
        }
    }

    bool wrap(Eigen::Array3i& row, Eigen::Vector3d& shift, int axis) const {
        const int turn = row[axis] < 0 ? -1 : (row[axis] >= boxes_[axis] ? 1 : 0);
        row[axis] -= turn * boxes_[axis];
        shift += turn * cell_.edges().col(axis);
        return turn == 0 || cell_.is_periodic(axis);
    }

    std::size_t slot_of(int bx, int by, int bz) const {
        return static_cast<std::size_t>((static_cast<Index>(bz) * boxes_[1] + by) * boxes_[0] + bx);
    }

    Cell cell_;
    double range_;
    Eigen::Array3d edge_;   ///< width of a box [m]
    Eigen::Array3i boxes_;  ///< along each axis
    Eigen::Array3i reach_;  ///< boxes that the range spans, at most all of them
    std::vector<Index> start_;
};

}  // namespace coagula::characterize
