// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: spread of the contact numbers, triangles, tetrahedra, loops, clusters, percolation.
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/topology.hpp>

#include <cmath>

namespace coagula::characterize {

Measure topology_measure();

namespace {

/// Means and shares of the particles and contacts that count.
struct Scalars {
    double contact_spread, triangles, largest_fraction, tetrahedra, outside_triangles, in_one_triangle;
    explicit Scalars(const Eigen::VectorXd& found)
        : contact_spread(found[0]),
          triangles(found[1]),
          largest_fraction(found[2]),
          tetrahedra(found[3]),
          outside_triangles(found[4]),
          in_one_triangle(found[5]) {}
};

/// The numbers of Scalars, from sums of the particle values.
Eigen::VectorXd scalars(const Eigen::VectorXd& sums) {
    const double mean = sums[1] / sums[0];
    const double contacts = std::max(0.5 * sums[1], 0.5);
    Eigen::VectorXd found(6);
    found << std::sqrt(std::max(0.0, sums[2] / sums[0] - mean * mean)), sums[3] / sums[0], sums[4] / sums[0], sums[5] / sums[0],
        sums[6] / contacts, sums[7] / contacts;
    return found;
}

/// 1, contacts, their square, a third of the triangles, membership of the largest cluster, a quarter of the tetrahedra, half of the
/// contacts in no triangle and in one, per particle.
Eigen::MatrixXd particle_values(const Topology& topology, const ContactNetwork& contacts) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(8, topology.counts.size());
    values.row(0).setOnes();
    values.row(1) = topology.counts.cast<double>();
    values.row(2) = values.row(1).array().square();
    values.row(3) = topology.triangles.cast<double>().transpose() / 3;
    values.row(4) = (topology.of_particle.array() == 0).cast<double>();
    values.row(5) = topology.tetrahedra.cast<double>().transpose() / 4;
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const int triangles = topology.triangles_of_contact[contact];
        if (triangles <= 1) {
            values(6 + triangles, contacts.ends(0, contact)) += 0.5;
            values(6 + triangles, contacts.ends(1, contact)) += 0.5;
        }
    }
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

void add_triangles(const Topology& topology, const Scalars& found, const Scalars& error, MeasureResult& result) {
    result.add("topology/triangles", found.triangles, "1", "triples of particles that touch each other, per particle",
               error.triangles);
    result.add_count("topology/triangle_count", topology.triangle_count, "triples of particles that touch each other");
    result.add("topology/tetrahedra", found.tetrahedra, "1", "sets of four particles that all touch each other, per particle",
               error.tetrahedra);
    result.add_count("topology/tetrahedron_count", topology.tetrahedron_count, "sets of four particles that all touch each other");
    result.add("topology/contacts_outside_triangles", found.outside_triangles, "1", "contacts in no triangle over all contacts",
               error.outside_triangles);
    result.add("topology/contacts_in_one_triangle", found.in_one_triangle, "1",
               "contacts in exactly one triangle over all contacts", error.in_one_triangle);
}

MeasureResult run_topology(const MeasureInput& input) {
    const Topology topology = measure_topology(input.packing(), input.contacts());
    const Eigen::MatrixXd values = particle_values(topology, input.contacts());
    const Scalars error(errors_of_means(input, values, scalars));
    const Scalars found(scalars(sum_inner(input, values)));
    MeasureResult result;
    result.add("topology/contact_spread", found.contact_spread, "1", "standard deviation of the number of contacts of a particle",
               error.contact_spread);
    add_triangles(topology, found, error, result);
    result.add_count("topology/loops", topology.loops, "independent loops: contacts - particles + connected parts");
    add_clusters(topology, found.largest_fraction, error.largest_fraction, result);
    result.add_field("triangles", topology.triangles.cast<double>().transpose(), "1", "triangles of contacts through the particle");
    result.add_line("spread of the contacts", with_unit(found.contact_spread, "1"));
    result.add_line("triangles per particle", with_unit(found.triangles, "1") + "; tetrahedra " + with_unit(found.tetrahedra, "1") +
                                                  "; " + with_unit(100 * found.outside_triangles, "%") +
                                                  " of the contacts are in no triangle");
    result.add_line("largest cluster", with_unit(100 * found.largest_fraction, "%") +
                                           " of the particles, reaches around the box in " + std::to_string(topology.windings()) +
                                           " independent ways");
    return result;
}

}  // namespace

Measure topology_measure() {
    return {.name = "topology",
            .summary = "spread of the contacts, triangles, tetrahedra, loops, clusters, percolation",
            .run = run_topology,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
