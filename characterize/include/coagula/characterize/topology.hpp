// SPDX-License-Identifier: GPL-3.0-or-later
// Topology of the contact network: spread of the contact numbers, triangles, loops, clusters.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/percolation.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

struct Topology {
    Eigen::VectorXi counts;                ///< N, contacts of each particle
    double mean = unset;                   ///< of the contact numbers
    double variance = unset;               ///< of the contact numbers: mean square deviation
    Eigen::VectorXi triangles;             ///< N, sets of three particles that touch each other, of which the particle is one
    Index triangle_count = 0;              ///< each counted once: a third of the sum
    Eigen::VectorXi tetrahedra;            ///< N, sets of four particles that touch each other, of which the particle is one
    Index tetrahedron_count = 0;           ///< each counted once: a quarter of the sum
    Eigen::VectorXi triangles_of_contact;  ///< M, triangles of which the contact is a side
    Index loops = 0;                       ///< independent ones (cycle rank): contacts - particles + connected parts
    std::vector<Cluster> clusters;         ///< of particles that hang together, largest first; none for a particle without contact
    Eigen::VectorXi of_particle;           ///< N: place in `clusters`; -1: no contact
    Index lone_particles = 0;              ///< without contact

    /// Whether some cluster meets an image of itself displaced along this axis (0, 1, 2).
    bool percolates(int axis) const;
    /// Independent windings of the largest cluster, 0 to 3.
    Index windings() const { return clusters.empty() ? 0 : static_cast<Index>(clusters.front().windings.size()); }
};

/// Triangles and tetrahedra close in space, not around the box (cliques.hpp).
/// Throws std::invalid_argument when the contacts belong to another packing.
Topology measure_topology(const Packing& packing, const ContactNetwork& contacts);

}  // namespace coagula::characterize
