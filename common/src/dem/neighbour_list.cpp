// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbour_list.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace coagula::dem {

namespace {

/// Calls visit(x, y, z) for the boxes of a cube of `edge`, a power of two, that lie below `count`, along a Morton curve.
template <class Visit>
void follow_curve(const Eigen::Array3i& corner, int edge, const Eigen::Array3i& count, const Visit& visit) {
    if ((corner >= count).any()) {
        return;
    }
    if (edge == 1) {
        visit(corner[0], corner[1], corner[2]);
        return;
    }
    const int half = edge / 2;
    for (int part = 0; part < 8; ++part) {
        follow_curve(corner + half * Eigen::Array3i(part & 1, (part >> 1) & 1, part >> 2), half, count, visit);
    }
}

}  // namespace

NeighbourSearch::NeighbourSearch(const Cell& cell, const std::vector<Quad>& position, double skin) : cell_(cell), skin_(skin) {
    require(std::all_of(position.begin(), position.end(), [](const Quad& sphere) { return sphere.allFinite(); }),
            "a particle is at a place that is not a finite number: the neighbour search cannot find its box");
    choose_boxes(position);
    list_places(position);
    rank_boxes();
    const std::size_t particles = position.size();
    std::vector<std::size_t> place(particles);
    start_.assign(rank_.size() + 1, 0);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        place[particle] = rank_of(box_of(position[particle]));
        ++start_[place[particle] + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    order_.resize(particles);
    smallest_.assign(rank_.size(), std::numeric_limits<double>::infinity());
    sorted_.resize(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        const auto number = static_cast<std::size_t>(next[place[particle]]++);
        order_[number] = static_cast<std::int32_t>(particle);
        sorted_[number] = position[particle];
        smallest_[place[particle]] = std::min(smallest_[place[particle]], position[particle][3]);
    }
}

void NeighbourSearch::choose_boxes(const std::vector<Quad>& position) {
    // The reach of most particles, so that only a few large ones look beyond the boxes next to theirs; but at most about two boxes
    // per particle.
    std::vector<double> radii;
    radii.reserve(position.size());
    for (const Quad& sphere : position) {
        radii.push_back(sphere[3]);
    }
    const auto most = radii.begin() + static_cast<std::ptrdiff_t>(4 * radii.size() / 5);
    std::nth_element(radii.begin(), most, radii.end());
    const double edge = std::max(2 * *most + skin_, std::cbrt(0.5 * cell_.volume() / static_cast<double>(radii.size())));
    for (int axis = 0; axis < 3; ++axis) {
        boxes_[axis] = static_cast<int>(std::clamp(cell_.widths()[axis] / edge, 1.0, 1000.0));
    }
}

void NeighbourSearch::rank_boxes() {
    rank_.resize(static_cast<std::size_t>(boxes_.prod()));
    const auto edge = static_cast<int>(std::bit_ceil(static_cast<unsigned>(boxes_.maxCoeff())));
    std::int32_t place = 0;
    follow_curve(Eigen::Array3i::Zero(), edge, boxes_, [&](int x, int y, int z) {
        rank_[static_cast<std::size_t>((static_cast<Index>(z) * boxes_[1] + y) * boxes_[0] + x)] = place++;
    });
}

Eigen::Array3i NeighbourSearch::box_of(const Quad& position) const {
    const Eigen::Array3d fraction = cell_.fraction(position.head<3>());
    // Rounding may put a wrapped point on the upper face; in an open cell particles may leave the box.
    return (fraction * boxes_.cast<double>()).floor().max(0).min((boxes_ - 1).cast<double>()).cast<int>();
}

std::size_t NeighbourSearch::rank_of(const Eigen::Array3i& box) const {
    return static_cast<std::size_t>(
        rank_[static_cast<std::size_t>((static_cast<Index>(box[2]) * boxes_[1] + box[1]) * boxes_[0] + box[0])]);
}

/// Brings the box numbers along each axis into the cell.
void NeighbourSearch::list_places(const std::vector<Quad>& position) {
    double largest = 0;
    for (const Quad& sphere : position) {
        largest = std::max(largest, sphere[3]);
    }
    margin_ = reach_of(largest);
    for (int axis = 0; axis < 3; ++axis) {
        const int count = boxes_[axis];
        for (int box = -margin_[axis]; box < count + margin_[axis]; ++box) {
            const int images = box >= 0 ? box / count : -((count - 1 - box) / count);
            places_[static_cast<std::size_t>(axis)].push_back(
                {box - images * count, images, images * cell_.edges().col(axis), images == 0 || cell_.is_periodic(axis)});
        }
    }
}

/// Boxes that a particle must look beyond its own.
Eigen::Array3i NeighbourSearch::reach_of(double radius) const {
    return ((2 * radius + skin_) * boxes_.cast<double>() / cell_.widths().array()).ceil().cast<int>();
}

const NeighbourSearch::Place& NeighbourSearch::place_along(int axis, int box) const {
    return places_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(box + margin_[axis])];
}

void NeighbourSearch::find_pairs_of(std::int32_t first, std::vector<ListedPair>& pairs) const {
    const Quad& centre = sorted_[static_cast<std::size_t>(first)];
    const Eigen::Array3i home = box_of(centre);
    const Eigen::Array3i reach = reach_of(centre[3]);
    for (int dz = -reach[2]; dz <= reach[2]; ++dz) {
        const Place& z = place_along(2, home[2] + dz);
        for (int dy = -reach[1]; dy <= reach[1]; ++dy) {
            const Place& y = place_along(1, home[1] + dy);
            if (!z.exists || !y.exists) {
                continue;
            }
            const std::int32_t* row = rank_.data() + (static_cast<Index>(z.box) * boxes_[1] + y.box) * boxes_[0];
            const Place* along = &place_along(0, home[0]);
            for (int dx = -reach[0]; dx <= reach[0]; ++dx) {
                const Place& x = along[dx];
                if (x.exists) {
                    const int side = dz != 0 ? dz : (dy != 0 ? dy : dx);
                    search_box(first, static_cast<std::size_t>(row[x.box]), side, x, y, z, pairs);
                }
            }
        }
    }
}

/// @param side sign of the box's place relative to the own box; equal particles are paired on the positive side only.
void NeighbourSearch::search_box(std::int32_t first, std::size_t place, int side, const Place& x, const Place& y, const Place& z,
                                 std::vector<ListedPair>& pairs) const {
    const Quad& centre = sorted_[static_cast<std::size_t>(first)];
    if (smallest_[place] > centre[3] || (side < 0 && smallest_[place] == centre[3])) {
        return;
    }
    const Eigen::Vector3d origin = centre.head<3>().matrix() - (x.shift + y.shift + z.shift);
    for (std::int32_t second = start_[place]; second < start_[place + 1]; ++second) {
        const Quad& other = sorted_[static_cast<std::size_t>(second)];
        const double limit = centre[3] + other[3] + skin_;
        if ((other.head<3>() - origin).squaredNorm() >= limit * limit) {
            continue;
        }
        const bool equal_counts = side > 0 || (side == 0 && second > first);
        if (other[3] < centre[3] || (other[3] == centre[3] && equal_counts)) {
            pairs.push_back({first, second, {x.images, y.images, z.images}});
        }
    }
}

}  // namespace coagula::dem
