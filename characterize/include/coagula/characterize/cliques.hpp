// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles and tetrahedra of the contact network, and the clusters of particles that they build.
#pragma once

#include <coagula/common/contact_network.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace coagula::characterize {

/// Sets of three and four particles that all touch each other. They close in space: a periodic box counts as its infinite
/// repetition, and what repeats with the box is listed once.
struct Cliques {
    Eigen::Matrix<std::int32_t, 3, Eigen::Dynamic> triangles;   ///< 3 x T: particles
    Eigen::Matrix<Index, 3, Eigen::Dynamic> triangle_contacts;  ///< 3 x T: columns in the network
    Eigen::Matrix<Index, 4, Eigen::Dynamic> tetrahedra;         ///< 4 x K: faces, which are columns of `triangles`
    Eigen::VectorXi triangles_of_contact;                       ///< M: triangles of which the contact is a side
    Eigen::VectorXi triangles_of_particle;                      ///< N: triangles of which the particle is a corner
    Eigen::VectorXi tetrahedra_of_particle;                     ///< N: tetrahedra of which the particle is a corner
};

/// O(N) for bounded contact numbers.
Cliques find_cliques(const ContactNetwork& contacts);

/// Particles held together by cliques that share all particles but one.
struct CliqueCommunity {
    std::vector<std::int32_t> particles;  ///< ascending
    std::vector<Index> contacts;          ///< sides of its cliques, ascending
};

/// Clique communities (Palla, Derenyi, Farkas and Vicsek, Nature 435 (2005) 814).
struct CliqueCommunities {
    std::vector<CliqueCommunity> communities;   ///< largest first by particles, then by contacts, then by their lowest particles
    std::vector<std::vector<int>> of_particle;  ///< N: places in `communities`, ascending; one particle may belong to several
    /// Whether some community has both particles.
    bool share_one(Index first, Index second) const;
};

/// @param size of a clique: 3 joins triangles that have a side in common, 4 joins tetrahedra that have a face in common.
/// Throws std::invalid_argument for other sizes.
CliqueCommunities find_clique_communities(const ContactNetwork& contacts, const Cliques& cliques, int size);

}  // namespace coagula::characterize
