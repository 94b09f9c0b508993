// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/topology.hpp>

#include <coagula/characterize/rings.hpp>

#include <algorithm>

namespace coagula::characterize {

bool Topology::percolates(int axis) const {
    return std::any_of(clusters.begin(), clusters.end(), [axis](const Cluster& cluster) { return cluster.percolates(axis); });
}

Topology measure_topology(const Packing& packing, const ContactNetwork& contacts) {
    Topology result;
    result.clusters = find_clusters(packing, contacts);
    result.of_particle = cluster_of_particles(contacts, result.clusters);
    result.lone_particles = (result.of_particle.array() < 0).count();
    const auto parts = static_cast<Index>(result.clusters.size()) + result.lone_particles;
    result.loops = contacts.size() - packing.size() + parts;
    result.counts = contact_counts(contacts);
    result.mean = result.counts.cast<double>().mean();
    result.variance = (result.counts.cast<double>().array() - result.mean).square().mean();
    result.triangles = measure_rings(contacts, 3).per_particle.row(3).transpose();
    result.triangle_count = result.triangles.cast<Index>().sum() / 3;
    return result;
}

}  // namespace coagula::characterize
