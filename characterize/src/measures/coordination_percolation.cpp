// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: percolation of the particles with three and more, and with six and more contacts.
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/coordination_percolation.hpp>

namespace coagula::characterize {

Measure coordination_percolation_measure();

namespace {

/// Shares of the selected particles and of the largest cluster, from sums of 1 and of these flags.
Eigen::VectorXd selected_shares(const Eigen::VectorXd& sums) {
    return sums.tail<2>() / sums[0];
}

void add_particles_with(int least, const std::string& word, const MeasureInput& input, MeasureResult& result) {
    const CoordinationPercolation found = measure_coordination_percolation(input.packing(), input.contacts(), least);
    Eigen::MatrixXd values(3, input.packing().size());
    values.row(0).setOnes();
    for (Index particle = 0; particle < values.cols(); ++particle) {
        values(1, particle) = found.selected[static_cast<std::size_t>(particle)] ? 1 : 0;
    }
    values.row(2) = (found.of_particle.transpose().array() == 0).cast<double>();
    const Eigen::VectorXd share = selected_shares(sum_inner(input, values));
    const double error = errors_of_means(input, values, selected_shares)[0];
    const std::string group = "coordination_percolation/" + word + "_or_more/";
    const std::string which = "particles with " + word + " or more contacts";
    result.add(group + "fraction", share[0], "1", which + " over all", error);
    // It comes from the whole structure: its sub-volumes do not tell how it varies.
    result.add(group + "largest_fraction", share[1], "1", "particles in the largest connected cluster of " + which + ", over all");
    const auto reaches = [&](int axis) { return found.percolates(axis) ? 1 : 0; };
    result.add_counts(group + "percolates", Eigen::Vector3i(reaches(0), reaches(1), reaches(2)),
                      "1 if some cluster of " + which + " reaches around the box along x, y, z");
    result.add_count(group + "windings", found.windings(),
                     "linearly independent ways in which their largest cluster reaches around the box, 0 to 3");
    result.add_line(word + " or more contacts", with_unit(100 * share[0], "%") + " of the particles; their largest cluster has " +
                                                    with_unit(100 * share[1], "%") + ", reaches around the box in " +
                                                    std::to_string(found.windings()) + " independent ways");
}

MeasureResult run_coordination_percolation(const MeasureInput& input) {
    MeasureResult result;
    add_particles_with(3, "three", input, result);
    add_particles_with(6, "six", input, result);
    return result;
}

}  // namespace

Measure coordination_percolation_measure() {
    return {.name = "coordination_percolation",
            .summary = "particles with three and with six or more contacts, their clusters, percolation",
            .run = run_coordination_percolation,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
