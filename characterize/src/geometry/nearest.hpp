// SPDX-License-Identifier: GPL-3.0-or-later
// The nearest neighbours of every particle. Internal.
#pragma once

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

struct Neighbour {
    int particle = 0;
    Eigen::Vector3d separation;  ///< from the particle to this one or its image [m]
    double squared_distance = 0;
};

/// The `count` nearest of each particle by centre distance, nearest first; images count as neighbours. Fewer in an open packing of
/// fewer particles.
std::vector<std::vector<Neighbour>> nearest_neighbours(const Packing& packing, Index count);

}  // namespace coagula::characterize
