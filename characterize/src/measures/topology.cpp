// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: spread of the contact numbers, triangles, loops, clusters, percolation.
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/topology.hpp>

#include <cmath>

namespace coagula::characterize {

Measure topology_measure();

namespace {

/// Mean of the contact numbers, their standard deviation, triangles per particle, share in the largest cluster.
Eigen::VectorXd scalars(const Eigen::VectorXd& sums) {
    const double mean = sums[1] / sums[0];
    return Eigen::Vector3d(std::sqrt(std::max(0.0, sums[2] / sums[0] - mean * mean)), sums[3] / sums[0], sums[4] / sums[0]);
}

/// 1, contacts, their square, a third of the triangles and membership of the largest cluster, per particle.
Eigen::MatrixXd particle_values(const Topology& topology) {
    Eigen::MatrixXd values(5, topology.counts.size());
    values.row(0).setOnes();
    values.row(1) = topology.counts.cast<double>();
    values.row(2) = values.row(1).array().square();
    values.row(3) = topology.triangles.cast<double>().transpose() / 3;
    values.row(4) = (topology.of_particle.array() == 0).cast<double>();
    return values;
}

void add_clusters(const Topology& topology, double largest, double error, MeasureResult& result) {
    result.add_count("topology/clusters", static_cast<Index>(topology.clusters.size()),
                     "connected clusters of two or more particles, or of one that touches its own image");
    result.add_count("topology/lone_particles", topology.lone_particles, "particles without contact");
    result.add("topology/largest_fraction", largest, "1", "particles in the largest cluster over all", error);
    const auto reaches = [&](int axis) { return topology.percolates(axis) ? 1 : 0; };
    result.add_counts("topology/percolates", Eigen::Vector3i(reaches(0), reaches(1), reaches(2)),
                      "1 if some cluster reaches around the box along x, y, z");
    result.add_count("topology/windings", topology.windings(),
                     "linearly independent ways in which the largest cluster reaches around the box, 0 to 3");
    result.add_field("cluster", (topology.of_particle.array() + 1).cast<double>().matrix().transpose(), "1",
                     "connected cluster of the particle, 1 the largest; 0: no contact");
}

MeasureResult run_topology(const MeasureInput& input) {
    const Topology topology = measure_topology(input.packing(), input.contacts());
    const Eigen::MatrixXd values = particle_values(topology);
    const Eigen::VectorXd error = errors_of_means(input, values, scalars);
    const Eigen::VectorXd found = scalars(sum_inner(input, values));
    MeasureResult result;
    result.add("topology/contact_spread", found[0], "1", "standard deviation of the number of contacts of a particle", error[0]);
    result.add("topology/triangles", found[1], "1", "triples of particles that touch each other, per particle", error[1]);
    result.add_count("topology/triangle_count", topology.triangle_count, "triples of particles that touch each other");
    result.add_count("topology/loops", topology.loops, "independent loops: contacts - particles + connected parts");
    add_clusters(topology, found[2], error[2], result);
    result.add_field("triangles", topology.triangles.cast<double>().transpose(), "1", "triangles of contacts through the particle");
    result.add_line("spread of the contacts", with_unit(found[0], "1"));
    result.add_line("triangles per particle", with_unit(found[1], "1"));
    result.add_line("largest cluster", with_unit(100 * found[2], "%") + " of the particles, reaches around the box in " +
                                           std::to_string(topology.windings()) + " independent ways");
    return result;
}

}  // namespace

Measure topology_measure() {
    return {.name = "topology",
            .summary = "spread of the contacts, triangles, loops, clusters, percolation",
            .run = run_topology,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
