// SPDX-License-Identifier: GPL-3.0-or-later
#include "bricks.hpp"

#include <algorithm>
#include <limits>

namespace coagula::mechanics {

Bricks::Bricks(const Eigen::Vector3d& lengths, int processes) {
    double least = std::numeric_limits<double>::infinity();
    for (int x = 1; x <= processes; ++x) {
        for (int y = 1; x * y <= processes; ++y) {
            const int z = processes / (x * y);
            const Eigen::Vector3d edge = lengths.array() / Eigen::Array3d(x, y, z);
            const double faces = edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
            if (x * y * z == processes && faces < least) {
                least = faces;
                count_ = {x, y, z};
            }
        }
    }
}

int Bricks::owner(const Eigen::Vector3d& fraction) const {
    std::array<int, 3> brick{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        brick[axis] = std::min(static_cast<int>(fraction[static_cast<Index>(axis)] * count_[axis]), count_[axis] - 1);
    }
    return (brick[2] * count_[1] + brick[1]) * count_[0] + brick[0];
}

}  // namespace coagula::mechanics
