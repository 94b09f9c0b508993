// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbour_list.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/dem/kernels.hpp>

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
    std::vector<std::size_t> box(particles);
    std::vector<std::int32_t> next(rank_.size() + 1, 0);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        box[particle] = number_of(box_of(position[particle]));
        ++next[static_cast<std::size_t>(rank_[box[particle]]) + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    order_.resize(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        const auto number = static_cast<std::size_t>(next[static_cast<std::size_t>(rank_[box[particle]])]++);
        order_[number] = static_cast<std::int32_t>(particle);
    }
    sorted_.resize(particles);
    std::vector<std::size_t> sorted_box(particles);
    for (std::size_t number = 0; number < particles; ++number) {
        const auto particle = static_cast<std::size_t>(order_[number]);
        sorted_[number] = position[particle];
        sorted_box[number] = box[particle];
    }
    sort_along_rows(sorted_box);
}

/// @param box of each sorted number.
void NeighbourSearch::sort_along_rows(const std::vector<std::size_t>& box) {
    start_.assign(rank_.size() + 1, 0);
    for (const std::size_t place : box) {
        ++start_[place + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    smallest_.assign(rank_.size(), std::numeric_limits<double>::infinity());
    along_rows_.resize(box.size());
    number_of_.resize(box.size());
    for (std::size_t number = 0; number < box.size(); ++number) {
        const auto place = static_cast<std::size_t>(next[box[number]]++);
        along_rows_[place] = sorted_[number];
        number_of_[place] = static_cast<std::int32_t>(number);
        smallest_[box[number]] = std::min(smallest_[box[number]], sorted_[number][3]);
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

std::size_t NeighbourSearch::number_of(const Eigen::Array3i& box) const {
    return static_cast<std::size_t>((static_cast<Index>(box[2]) * boxes_[1] + box[1]) * boxes_[0] + box[0]);
}

/// Brings the box numbers along each axis into the cell.
void NeighbourSearch::list_places(const std::vector<Quad>& position) {
    double largest = 0;
    for (const Quad& sphere : position) {
        largest = std::max(largest, sphere[3]);
    }
    margin_ = reach_of(largest);
    next_boxes_ = (margin_ <= 1).all();
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

void NeighbourSearch::find_pairs_of(std::int32_t first, std::vector<ListedPair>& pairs, std::vector<std::int32_t>& scratch) const {
    const Quad& centre = sorted_[static_cast<std::size_t>(first)];
    const Eigen::Array3i reach = reach_of(centre[3]);
    const Seeker seeker{first, box_of(centre), reach[0], scratch, pairs};
    for (int dz = -reach[2]; dz <= reach[2]; ++dz) {
        const Place& z = place_along(2, seeker.home[2] + dz);
        for (int dy = -reach[1]; dy <= reach[1]; ++dy) {
            const Place& y = place_along(1, seeker.home[1] + dy);
            const int side = dz != 0 ? dz : dy;
            if (z.exists && y.exists && !(next_boxes_ && side < 0)) {
                search_row(seeker, side, y, z);
            }
        }
    }
}

/// @param side sign of the row's place relative to the own one; equal particles, or all of them, are paired on the positive side.
void NeighbourSearch::search_row(const Seeker& seeker, int side, const Place& y, const Place& z) const {
    const std::size_t row = number_of({0, y.box, z.box});
    const int last = seeker.home[0] + seeker.reach;
    int count = 1;
    for (int box = seeker.home[0] - seeker.reach; box <= last; box += count) {
        const Place& x = place_along(0, box);
        // The own row is searched box by box, because the side changes there; another row as far as the period goes.
        count = side == 0 ? 1 : std::min(last - box + 1, boxes_[0] - x.box);
        if (x.exists) {
            search_boxes(seeker, row + static_cast<std::size_t>(x.box), static_cast<std::size_t>(count),
                         side != 0 ? side : box - seeker.home[0], x.shift + y.shift + z.shift, {x.images, y.images, z.images});
        }
    }
}

/// Whether the boxes may hold a partner that is found from a particle of this radius.
bool NeighbourSearch::has_smaller(std::size_t first_box, std::size_t count, int side, double radius) const {
    double smallest = smallest_[first_box];
    for (std::size_t box = first_box + 1; box < first_box + count; ++box) {
        smallest = std::min(smallest, smallest_[box]);
    }
    return smallest < radius || (smallest == radius && side >= 0);
}

/// Searches `count` boxes that follow each other along x.
void NeighbourSearch::search_boxes(const Seeker& seeker, std::size_t first_box, std::size_t count, int side,
                                   const Eigen::Vector3d& shift, const Eigen::Vector3i& images) const {
    const auto begin = static_cast<std::size_t>(start_[first_box]);
    const auto end = static_cast<std::size_t>(start_[first_box + count]);
    Quad centre = sorted_[static_cast<std::size_t>(seeker.number)];
    const double radius = centre[3];
    if (next_boxes_ ? side < 0 : !has_smaller(first_box, count, side, radius)) {
        return;
    }
    centre.head<3>() -= shift;
    centre[3] += skin_;
    seeker.found.resize(std::max(seeker.found.size(), end - begin));
    const std::size_t found =
        detail::fastest_kernels().find_near(along_rows_.data()->data(), begin, end, centre.data(), seeker.found.data());
    for (std::size_t entry = 0; entry < found; ++entry) {
        const auto place = static_cast<std::size_t>(seeker.found[entry]);
        const std::int32_t second = number_of_[place];
        const double other = next_boxes_ ? radius : along_rows_[place][3];
        const bool equal_counts = side > 0 || (side == 0 && second > seeker.number);
        if (other < radius || (other == radius && equal_counts)) {
            seeker.pairs.push_back({seeker.number, second, images});
        }
    }
}

}  // namespace coagula::dem
