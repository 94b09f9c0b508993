#include "geodesic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace coagula::characterize {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class FastMarching {
public:
    FastMarching(const VoxelGrid& grid, const std::vector<double>& distances, int axis)
        : grid_(grid), open_(distances), axis_(axis), time_(distances.size(), infinity), final_(distances.size(), 0) {
        stride_ = {1, grid.count[0], static_cast<Index>(grid.count[0]) * grid.count[1]};
    }

    double mean_path() {
        for (Index voxel = 0; voxel < grid_.voxels(); ++voxel) {
            if (place_of(voxel, axis_) == 0) {
                offer(voxel, grid_.edge[axis_] / 2);
            }
        }
        while (!front_.empty()) {
            const auto [time, voxel] = front_.top();
            front_.pop();
            if (final_[static_cast<std::size_t>(voxel)] == 0) {
                final_[static_cast<std::size_t>(voxel)] = 1;
                pass_on(voxel);
            }
        }
        double sum = 0, count = 0;
        for (Index voxel = 0; voxel < grid_.voxels(); ++voxel) {
            const double time = time_[static_cast<std::size_t>(voxel)];
            if (place_of(voxel, axis_) == grid_.count[axis_] - 1 && time < infinity) {
                sum += time + grid_.edge[axis_] / 2;
                count += 1;
            }
        }
        return count > 0 ? sum / count : infinity;
    }

private:
    int place_of(Index voxel, int axis) const {
        return static_cast<int>(voxel / stride_[static_cast<std::size_t>(axis)] % grid_.count[axis]);
    }

    /// The next voxel along an axis, or -1 beyond the first and last plane.
    Index neighbour(Index voxel, int axis, int side) const {
        const int place = place_of(voxel, axis);
        const int count = grid_.count[axis];
        const Index stride = stride_[static_cast<std::size_t>(axis)];
        if (place + side >= 0 && place + side < count) {
            return voxel + side * stride;
        }
        return axis == axis_ ? -1 : voxel - side * (count - 1) * stride;
    }

    void offer(Index voxel, double time) {
        const auto k = static_cast<std::size_t>(voxel);
        if (open_[k] > 0 && time < time_[k]) {
            time_[k] = time;
            front_.push({time, voxel});
        }
    }

    void pass_on(Index voxel) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {-1, 1}) {
                const Index other = neighbour(voxel, axis, side);
                if (other >= 0 && final_[static_cast<std::size_t>(other)] == 0 && open_[static_cast<std::size_t>(other)] > 0) {
                    offer(other, arrival(other));
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

    double final_time(Index voxel) const {
        return voxel >= 0 && final_[static_cast<std::size_t>(voxel)] != 0 ? time_[static_cast<std::size_t>(voxel)] : infinity;
    }

    /// Of second order where the voxel behind the neighbour is earlier still, (3 t - 4 t1 + t2) / (2 edge); else of first order.
    Upwind upwind(Index voxel, int axis) const {
        const double inverse = 1 / (grid_.edge[axis] * grid_.edge[axis]);
        Upwind best;
        for (const int side : {-1, 1}) {
            const Index next = neighbour(voxel, axis, side);
            const double near = final_time(next);
            if (near < best.time) {
                const double far = final_time(neighbour(next, axis, side));
                best = far <= near ? Upwind{near + (near - far) / 3, 2.25 * inverse} : Upwind{near, inverse};
            }
        }
        return best;
    }

    /// Solves sum_axis ((t - t_axis) / edge)^2 = 1 over the earlier neighbours.
    double arrival(Index voxel) const {
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
    const std::vector<double>& open_;
    int axis_;
    std::array<Index, 3> stride_;
    std::vector<double> time_;
    std::vector<char> final_;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
};

}  // namespace

double geodesic_tortuosity(const VoxelGrid& grid, const std::vector<double>& distances, int axis) {
    return FastMarching(grid, distances, axis).mean_path() / (grid.edge[axis] * grid.count[axis]);
}

}  // namespace coagula::characterize
