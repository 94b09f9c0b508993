// SPDX-License-Identifier: GPL-3.0-or-later
#include "pair_runs.hpp"

#include <coagula/common/checks.hpp>

namespace coagula::characterize {

PairRuns::PairRuns(const Packing& packing, double range) : cell_(packing.cell), range_(range) {
    constexpr double boxes_per_range = 4;
    const auto particles = static_cast<std::size_t>(packing.size());
    Eigen::Matrix3Xd wrapped(3, packing.size());
    Eigen::Array3Xd place(3, packing.size());  // in fractions of the edges
    for (Index i = 0; i < packing.size(); ++i) {
        wrapped.col(i) = cell_.wrap(packing.positions.col(i));
        place.col(i) = cell_.fraction(wrapped.col(i));
    }
    Eigen::Array3d lower = Eigen::Array3d::Zero();
    Eigen::Array3d span = Eigen::Array3d::Ones();
    for (int axis = 0; axis < 3; ++axis) {
        if (!cell_.is_periodic(axis)) {
            lower[axis] = place.row(axis).minCoeff();
            span[axis] = std::max(place.row(axis).maxCoeff() - lower[axis], range / cell_.widths()[axis]);
        }
    }
    const Eigen::Array3d length = span * cell_.widths().array();
    const double smallest = std::cbrt(0.5 * length.prod() / static_cast<double>(particles));
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = std::max(range / boxes_per_range, smallest);
        boxes_[axis] = std::max(1, static_cast<int>(std::min(length[axis] / edge, 1000.0)));
        edge_[axis] = length[axis] / boxes_[axis];
        reach_[axis] = std::min(boxes_[axis], static_cast<int>(std::ceil(range / edge_[axis])));
    }
    std::vector<std::size_t> slot(particles);
    start_.assign(static_cast<std::size_t>(boxes_.prod()) + 1, 0);
    for (std::size_t i = 0; i < particles; ++i) {
        const auto column = static_cast<Index>(i);
        const Eigen::Array3d inside = (place.col(column) - lower) / span * boxes_.cast<double>();
        const Eigen::Array3i box = inside.floor().max(0.0).min(boxes_.cast<double>() - 1).cast<int>();
        slot[i] = slot_of(box[0], box[1], box[2]);
        ++start_[slot[i] + 1];
    }
    for (std::size_t box = 1; box < start_.size(); ++box) {
        start_[box] += start_[box - 1];
    }
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    x.resize(particles);
    y.resize(particles);
    z.resize(particles);
    particle.resize(particles);
    for (std::size_t i = 0; i < particles; ++i) {
        const auto entry = static_cast<std::size_t>(next[slot[i]]++);
        const auto column = static_cast<Index>(i);
        x[entry] = wrapped(0, column);
        y[entry] = wrapped(1, column);
        z[entry] = wrapped(2, column);
        particle[entry] = static_cast<std::int32_t>(i);
    }
}

}  // namespace coagula::characterize
