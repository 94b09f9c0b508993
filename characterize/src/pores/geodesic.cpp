// SPDX-License-Identifier: GPL-3.0-or-later
#include "geodesic.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace coagula::characterize {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Voxels by arrival time, earliest first, and those of equal time by number. Only those due next are kept as a heap; the others
/// wait in bins of equal width.
class Front {
public:
    using Entry = std::pair<double, std::int32_t>;  // time, voxel

    explicit Front(double width) : inverse_width_(1 / width) {}

    void push(double time, std::int32_t voxel) {
        const auto bin = static_cast<std::size_t>(time * inverse_width_);
        if (bin < next_) {
            due_.emplace_back(time, voxel);
            std::push_heap(due_.begin(), due_.end(), std::greater<>());
            return;
        }
        if (bin >= later_.size()) {
            later_.resize(bin + 1);
        }
        later_[bin].emplace_back(time, voxel);
    }

    bool is_empty() {
        while (due_.empty() && next_ < later_.size()) {
            due_ = std::move(later_[next_]);
            later_[next_] = {};
            std::make_heap(due_.begin(), due_.end(), std::greater<>());
            ++next_;
        }
        return due_.empty();
    }

    /// Not of an empty front: ask first.
    Entry pop() {
        std::pop_heap(due_.begin(), due_.end(), std::greater<>());
        const Entry entry = due_.back();
        due_.pop_back();
        return entry;
    }

private:
    double inverse_width_;
    std::size_t next_ = 0;  // the first bin that waits
    std::vector<Entry> due_;
    std::vector<std::vector<Entry>> later_;
};

/// A voxel and its place along the axes.
struct Voxel {
    std::int32_t number;
    std::array<int, 3> place;
};

class FastMarching {
public:
    FastMarching(const VoxelGrid& grid, const std::vector<double>& distances, int axis)
        : grid_(grid),
          axis_(static_cast<std::size_t>(axis)),
          time_(distances.size()),
          front_(grid.edge.minCoeff() / bins_per_voxel) {
        std::transform(distances.begin(), distances.end(), time_.begin(), [](double d) { return d > 0 ? -infinity : infinity; });
        std::int32_t stride = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t count = grid.count[static_cast<Index>(k)];
            edge_[k] = grid.edge[static_cast<Index>(k)];
            step_[k][0].assign(static_cast<std::size_t>(count), -stride);
            step_[k][1].assign(static_cast<std::size_t>(count), stride);
            step_[k][0].front() = k == axis_ ? none : (count - 1) * stride;
            step_[k][1].back() = k == axis_ ? none : -(count - 1) * stride;
            stride *= count;
        }
    }

    double mean_path() {
        for_plane(0, [&](std::int32_t voxel) { offer(voxel, edge_[axis_] / 2); });
        while (!front_.is_empty()) {
            const auto [time, number] = front_.pop();
            double& known = time_[static_cast<std::size_t>(number)];
            if (known < 0) {
                known = time;
                pass_on(voxel_at(number));
            }
        }
        double sum = 0, count = 0;
        for_plane(grid_.count[static_cast<Index>(axis_)] - 1, [&](std::int32_t voxel) {
            const double time = time_[static_cast<std::size_t>(voxel)];
            if (time > 0 && time < infinity) {
                sum += time + edge_[axis_] / 2;
                count += 1;
            }
        });
        return count > 0 ? sum / count : infinity;
    }

private:
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();
    static constexpr double bins_per_voxel = 16;

    Voxel voxel_at(std::int32_t number) const {
        const int row = number / grid_.count[0];
        return {number, {number - row * grid_.count[0], row % grid_.count[1], row / grid_.count[1]}};
    }

    /// Calls visit(number) for the voxels of one layer across the axis, in the order of their numbers.
    template <class Visit>
    void for_plane(int layer, Visit&& visit) const {
        for (std::int32_t voxel = 0; voxel < grid_.voxels(); ++voxel) {
            if (voxel_at(voxel).place[axis_] == layer) {
                visit(voxel);
            }
        }
    }

    /// How far the number of the next voxel along an axis is; none beyond the first and last layer.
    std::int32_t step(const Voxel& voxel, std::size_t axis, std::size_t side) const {
        return step_[axis][side][static_cast<std::size_t>(voxel.place[axis])];
    }

    Voxel moved(Voxel voxel, std::size_t axis, std::size_t side) const {
        const int last = grid_.count[static_cast<Index>(axis)] - 1;
        int& place = voxel.place[axis];
        voxel.number += step(voxel, axis, side);
        place = side == 0 ? (place == 0 ? last : place - 1) : (place == last ? 0 : place + 1);
        return voxel;
    }

    void offer(std::int32_t voxel, double time) {
        double& known = time_[static_cast<std::size_t>(voxel)];
        if (time < -known) {
            known = -time;
            front_.push(time, voxel);
        }
    }

    void pass_on(const Voxel& voxel) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (std::size_t side = 0; side < 2; ++side) {
                if (step(voxel, axis, side) == none) {
                    continue;
                }
                const Voxel other = moved(voxel, axis, side);
                if (time_[static_cast<std::size_t>(other.number)] < 0) {
                    offer(other.number, arrival(other));
                }
            }
        }
    }

    /// One-sided derivative along one axis as (t - time) sqrt(weight).
    struct Upwind {
        double time = infinity;
        double weight = 0;

        bool operator<(const Upwind& other) const { return time < other.time; }
    };

    double final_time(const Voxel& voxel, std::size_t axis, std::size_t side) const {
        const std::int32_t distance = step(voxel, axis, side);
        if (distance == none) {
            return infinity;
        }
        const std::int32_t neighbour = voxel.number + distance;
        const double time = time_[static_cast<std::size_t>(neighbour)];
        return time > 0 ? time : infinity;
    }

    /// The derivative along an axis towards the earlier side. It is of second order, (3 t - 4 t1 + t2) / (2 edge), where the voxel
    /// behind the neighbour is earlier still, otherwise of first order.
    Upwind upwind(const Voxel& voxel, std::size_t axis) const {
        const double inverse = 1 / (edge_[axis] * edge_[axis]);
        Upwind best;
        for (std::size_t side = 0; side < 2; ++side) {
            const double near = final_time(voxel, axis, side);
            if (near < best.time) {
                const double far = final_time(moved(voxel, axis, side), axis, side);
                best = far <= near ? Upwind{near + (near - far) / 3, 2.25 * inverse} : Upwind{near, inverse};
            }
        }
        return best;
    }

    /// Solves sum_axis ((t - t_axis) / edge)^2 = 1 over the earlier neighbours.
    double arrival(const Voxel& voxel) const {
        std::array<Upwind, 3> earlier = {upwind(voxel, 0), upwind(voxel, 1), upwind(voxel, 2)};
        std::sort(earlier.begin(), earlier.end());
        double a = 0, b = 0, c = -1, found = infinity;
        for (const auto& [time, weight] : earlier) {
            if (time >= found) {
                break;
            }
            a += weight;
            b += weight * time;
            c += weight * time * time;
            const double root = b * b - a * c;
            if (root < 0) {
                break;
            }
            found = (b + std::sqrt(root)) / a;
        }
        return found;
    }

    const VoxelGrid& grid_;
    std::size_t axis_;
    std::array<double, 3> edge_{};
    std::array<std::array<std::vector<std::int32_t>, 2>, 3> step_;
    /// Arrival of the front. Negative: the earliest one so far, or -infinity, of a voxel that it has not passed; infinite: closed.
    std::vector<double> time_;
    Front front_;
};

}  // namespace

double geodesic_tortuosity(const VoxelGrid& grid, const std::vector<double>& distances, int axis) {
    return FastMarching(grid, distances, axis).mean_path() / (grid.edge[axis] * grid.count[axis]);
}

}  // namespace coagula::characterize
