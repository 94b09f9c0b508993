// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/cell_list.hpp>
#include <coagula/common/checks.hpp>

#include <algorithm>

namespace coagula {

CellList::CellList(const Cell& cell, const Eigen::Matrix3Xd& positions, double cutoff) : cell_(cell) {
    require_positive(cutoff, "the cut-off of the neighbour search", "m");
    require(positions.allFinite(),
            "a particle is at a place that is not a finite number: the neighbour search cannot find its box");
    const auto particles = static_cast<std::size_t>(positions.cols());
    // Boxes never smaller than half of the volume per particle: an absurdly small cut-off must not exhaust the memory.
    const double smallest = std::cbrt(0.5 * cell.volume() / std::max(1.0, static_cast<double>(particles)));
    for (int axis = 0; axis < 3; ++axis) {
        const double width = cell.widths()[axis];
        boxes_[axis] = std::max(1, static_cast<int>(std::min(width / std::max(cutoff, smallest), 1000.0)));
        reach_[axis] = static_cast<int>(std::ceil(cutoff * boxes_[axis] / width));
    }
    start_.assign(static_cast<std::size_t>(boxes_.prod()) + 1, 0);
    std::vector<std::size_t> slot(particles);
    std::vector<Eigen::Vector3d> wrapped(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        wrapped[particle] = cell.wrap(positions.col(static_cast<Index>(particle)));
        // A wrapped point may round up to the upper face of the cell; it belongs to the last box.
        const Eigen::Array3i box = box_of(wrapped[particle]).min(boxes_ - 1);
        slot[particle] = slot_of(box);
        ++start_[slot[particle] + 1];
    }
    for (std::size_t box = 1; box < start_.size(); ++box) {
        start_[box] += start_[box - 1];
    }
    std::vector<int> next(start_.begin(), start_.end() - 1);
    order_.resize(particles);
    sorted_.resize(3, positions.cols());
    for (std::size_t particle = 0; particle < particles; ++particle) {
        const int entry = next[slot[particle]]++;
        order_[static_cast<std::size_t>(entry)] = static_cast<int>(particle);
        sorted_.col(entry) = wrapped[particle];
    }
}

Eigen::Array3i CellList::box_of(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d fraction = cell_.fraction(point);
    Eigen::Array3i box;
    for (int axis = 0; axis < 3; ++axis) {
        box[axis] = static_cast<int>(std::floor(std::clamp(fraction[axis], -1e6, 1e6) * boxes_[axis]));
        box[axis] = cell_.is_periodic(axis) ? box[axis] : std::clamp(box[axis], 0, boxes_[axis] - 1);
    }
    return box;
}

}  // namespace coagula
