// SPDX-License-Identifier: GPL-3.0-or-later
// Who touches whom: pairs of particles with the vector that joins their centres.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace coagula {

/// Contacts (or bonds) of a packing; each pair once, sorted by (first, second), first < second unless a particle meets its own
/// image.
struct ContactNetwork {
    Index particles = 0;                                  ///< number of particles N; ends lie in [0, N)
    Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic> ends;  ///< 2 x M: first, second
    Eigen::Matrix3Xd branch;  ///< 3 x M: centre of second minus centre of first, through the periodic boundary [m]

    Index size() const { return ends.cols(); }
};

/// All pairs with centre distance < (1 + tolerance) (r_i + r_j), periodic images included, also in cells so small that
/// one pair meets through several images. Sorted. O(N).
/// @param tolerance relative, > -1; 0.01 is the paper's.
ContactNetwork find_contacts(const Packing& packing, double tolerance);

/// All pairs with centre distance < cutoff [m], as find_contacts.
ContactNetwork find_pairs(const Packing& packing, double cutoff);

/// Number of contacts of every particle (N).
Eigen::VectorXi contact_counts(const ContactNetwork& network);

/// Mean number of contacts per particle, 2 M / N; rattlers are included.
double coordination_number(const ContactNetwork& network);

/// Contacts grouped by particle (compressed rows): those of particle i are entries start[i] .. start[i+1].
struct ContactsByParticle {
    std::vector<Index> start;    ///< N + 1
    std::vector<Index> contact;  ///< 2 M: column in the network
};
ContactsByParticle group_by_particle(const ContactNetwork& network);

}  // namespace coagula
