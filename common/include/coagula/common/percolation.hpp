// SPDX-License-Identifier: GPL-3.0-or-later
// Connected clusters of bonds, and whether they reach around a periodic box.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula {

/// Particles joined by bonds.
struct Cluster {
    Index first = 0;  ///< its particle of lowest index
    Index particles = 0;
    Index bonds = 0;
    /// Walks along bonds from a particle to an image of itself, counted in boxes along x, y, z: as many linearly independent ones
    /// as there are, at most three. Empty for a cluster of finite extent, and in an open cell.
    std::vector<Eigen::Vector3i> windings;

    /// Whether the cluster meets an image of itself that is displaced along this axis (0, 1, 2).
    bool percolates(int axis) const;
};

/// The clusters that have at least one bond, largest first (by particles, then by `first`). Union-find in which every particle
/// carries the image of the box it lies in (Machta et al., Phys. Rev. E 54 (1996) 1332); O(M) but for a sort of the clusters.
/// @param selected one flag per bond, only these count; empty: all.
/// Throws std::invalid_argument when bonds or flags do not belong to the packing.
std::vector<Cluster> find_clusters(const Packing& packing, const ContactNetwork& bonds, const std::vector<bool>& selected = {});

/// For each particle (N), which of the clusters that find_clusters found for the same bonds it belongs to; -1: to none of them.
Eigen::VectorXi cluster_of_particles(const ContactNetwork& bonds, const std::vector<Cluster>& clusters,
                                     const std::vector<bool>& selected = {});

}  // namespace coagula
