// SPDX-License-Identifier: GPL-3.0-or-later
// Percolation of the particles that have many contacts.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/percolation.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

/// The network of the particles that have at least `least` contacts, and of the contacts between two of these.
struct CoordinationPercolation {
    int least = 0;
    std::vector<bool> selected;     ///< N: whether the particle has so many contacts in the whole network
    std::vector<Cluster> clusters;  ///< of selected particles that hang together, largest first; none of a single particle
    Eigen::VectorXi of_particle;    ///< N: place in `clusters`; -1: in none

    /// Whether some cluster meets an image of itself displaced along this axis (0, 1, 2).
    bool percolates(int axis) const;
    /// Independent windings of the largest cluster, 0 to 3.
    Index windings() const { return clusters.empty() ? 0 : static_cast<Index>(clusters.front().windings.size()); }
};

/// Three contacts are the criterion of arXiv:2307.13315 for the onset of rigidity; particles with six are isostatic (Tsurusawa et
/// al., Science Advances 5 (2019) eaav6090). Contacts to particles with fewer contacts count, too: it is no k-core.
/// Throws std::invalid_argument when the contacts belong to another packing.
CoordinationPercolation measure_coordination_percolation(const Packing& packing, const ContactNetwork& contacts, int least);

}  // namespace coagula::characterize
