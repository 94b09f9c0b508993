// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/coordination_percolation.hpp>

#include <algorithm>

namespace coagula::characterize {

bool CoordinationPercolation::percolates(int axis) const {
    return std::any_of(clusters.begin(), clusters.end(), [axis](const Cluster& cluster) { return cluster.percolates(axis); });
}

CoordinationPercolation measure_coordination_percolation(const Packing& packing, const ContactNetwork& contacts, int least) {
    CoordinationPercolation result;
    result.least = least;
    for (const int count : contact_counts(contacts)) {
        result.selected.push_back(count >= least);
    }
    std::vector<bool> between(static_cast<std::size_t>(contacts.size()));
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        between[static_cast<std::size_t>(contact)] = result.selected[static_cast<std::size_t>(contacts.ends(0, contact))] &&
                                                     result.selected[static_cast<std::size_t>(contacts.ends(1, contact))];
    }
    result.clusters = find_clusters(packing, contacts, between);
    result.of_particle = cluster_of_particles(contacts, result.clusters, between);
    return result;
}

}  // namespace coagula::characterize
