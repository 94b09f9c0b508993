// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/topology.hpp>

#include <coagula/characterize/cliques.hpp>

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
    const Cliques cliques = find_cliques(contacts);
    result.triangles = cliques.triangles_of_particle;
    result.triangle_count = cliques.triangles.cols();
    result.tetrahedra = cliques.tetrahedra_of_particle;
    result.tetrahedron_count = cliques.tetrahedra.cols();
    result.triangles_of_contact = cliques.triangles_of_contact;
    return result;
}

}  // namespace coagula::characterize
