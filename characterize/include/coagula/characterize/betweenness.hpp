// SPDX-License-Identifier: GPL-3.0-or-later
// Edge betweenness of the contact network.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

/// Share of all pairs of particles whose shortest way through the network, counted in contacts, runs through a contact. Where a
/// pair has several shortest ways, each counts alike and all together count one. The network is that of the N particles: ways
/// may pass through the periodic boundary.
struct Betweenness {
    Eigen::VectorXd of_contact;  ///< M, over the number of pairs N (N - 1) / 2
    double connected_pairs = 0;  ///< share of the pairs that a way joins
    double mean_distance = 0;    ///< contacts on the shortest way, mean over the pairs that a way joins; 0 if there are none

    double mean() const { return of_contact.size() > 0 ? of_contact.mean() : 0.0; }
    /// Standard deviation over mean; 0 if there are no contacts.
    double spread() const;
    /// Share of the sum that the contacts of largest betweenness carry. @param fraction of the contacts, 0 to 1; a last contact
    /// counts in part.
    double share_of_largest(double fraction) const;
};

/// Accumulation from every particle (Brandes, J. Math. Sociol. 25 (2001) 163). O(N M) time; the same bits for any number of
/// threads.
Betweenness measure_betweenness(const ContactNetwork& contacts, const Progress& progress = {});

}  // namespace coagula::characterize
