// SPDX-License-Identifier: GPL-3.0-or-later
// Shortest-path rings of the contact network.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

/// A closed walk over n different particles is a shortest-path ring when no two of them are nearer to each other through the
/// network than along the ring (Franzblau, Phys. Rev. B 44 (1991) 4925). It closes in space: walks around a periodic box are no
/// rings.
struct Rings {
    int largest = 0;               ///< size up to which they were searched
    Eigen::MatrixXi per_particle;  ///< (largest + 1) x N: rings of size n through the particle; rows 0 to 2 are zero
    /// Number of rings of size n, n = 0 .. largest; each counted once.
    Eigen::VectorXd count() const;
};

/// O(N) for bounded contact numbers; grows like the number of particles within largest / 2 contacts squared.
/// The distances are those through the network in space, so that a small periodic box counts as its infinite repetition.
/// Throws std::invalid_argument unless 3 <= largest <= 12.
Rings measure_rings(const ContactNetwork& contacts, int largest, const Progress& progress = {});

}  // namespace coagula::characterize
