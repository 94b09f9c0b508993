// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: coordination number and rattlers.
#include "inner_sums.hpp"
#include "measure_options.hpp"

namespace coagula::characterize {

Measure coordination_measure();

namespace {

/// Standard errors of the mean number of contacts, of the fraction of particles with fewer than three, of the fraction of rattlers
/// and of the mean number of contacts among the others.
Eigen::VectorXd mean_errors(const MeasureInput& input, const Coordination& coordination) {
    const Eigen::VectorXi left = prune_rattlers(coordination.contacts);
    Eigen::MatrixXd values(5, left.size());
    values.row(0).setOnes();
    values.row(1) = coordination.counts.cast<double>();
    values.row(2) = (coordination.counts.array() < 3).cast<double>();
    values.row(3) = (left.array() < 0).cast<double>();
    values.row(4) = left.cwiseMax(0).cast<double>();
    return errors_of_means(input, values, [](const Eigen::VectorXd& sum) {
        return Eigen::VectorXd{{sum[1] / sum[0], sum[2] / sum[0], sum[3] / sum[0], sum[4] / std::max(1.0, sum[0] - sum[3])}};
    });
}

void add_means(const Coordination& coordination, double tolerance, const Eigen::VectorXd& error, MeasureResult& result) {
    const bool has_surface = coordination.inner_particles < coordination.contacts.particles;
    result.add(
        "coordination", coordination.mean, "1",
        std::string("mean number of contacts of ") + (has_surface ? "an inner particle" : "a particle") + ", rattlers included",
        error[0]);
    if (has_surface) {
        result.add_count("inner_particles", coordination.inner_particles,
                         "particles that no neighbour beyond the free surface could touch: the means are over these");
        result.add("coordination_all", coordination.mean_all, "1",
                   "mean number of contacts of a particle, those at the free surface included", error[0]);
    }
    result.add("contact_tolerance", tolerance, "1", "pairs nearer than (1 + tolerance) (r_i + r_j) are in contact");
    result.add("coordination_without_rattlers", coordination.mean_without_rattlers, "1",
               "contacts among the other particles, per particle", error[3]);
    result.add("rattler_fraction", coordination.rattler_fraction, "1",
               "fraction of particles left with fewer than two contacts when such particles are removed again and again", error[2]);
    result.add("below_three_fraction", coordination.below_three_fraction, "1",
               "fraction of the particles with fewer than three contacts", error[1]);
}

MeasureResult run_coordination(const MeasureInput& input) {
    const Coordination& coordination = input.coordination();
    const double tolerance = input.number("contact-tolerance");
    MeasureResult result;
    add_means(coordination, tolerance, mean_errors(input, coordination), result);
    result.add_count("contacts", coordination.contacts.size(), "number of contacts");
    result.add_counts("coordination_histogram", coordination.histogram, "number of particles with 0, 1, 2 ... contacts");
    result.add_field("coordination", coordination.counts.cast<double>().transpose(), "1", "number of contacts of the particle");
    result.add_line("coordination number",
                    with_unit(coordination.mean, "1") + "   (contacts within " + with_unit(1 + tolerance, "1") + " diameters)");
    result.add_line("rattlers", with_unit(100 * coordination.rattler_fraction, "%") + " of the particles");
    return result;
}

}  // namespace

Measure coordination_measure() {
    return {.name = "coordination",
            .summary = "contacts per particle, rattlers",
            .run = run_coordination,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
