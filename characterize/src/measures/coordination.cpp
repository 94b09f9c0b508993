// Measure: coordination number and rattlers.
#include "measure_options.hpp"

namespace coagula::characterize {

Measure coordination_measure();

namespace {

/// Standard errors of the mean number of contacts and of the fraction of particles with fewer than three; structures of the same
/// kind have the same number density.
Eigen::VectorXd mean_errors(const MeasureInput& input, const Eigen::VectorXi& counts) {
    Eigen::MatrixXd values(4, counts.size());
    values.row(0) = counts.cast<double>();
    values.row(1) = (counts.array() < 3).cast<double>();
    values.row(2).setOnes();
    values.row(3) = input.voronoi_cells().volumes;
    return block_errors(
        sum_by_block(input.blocks(), values), [](const Eigen::VectorXd& sum) { return Eigen::VectorXd(sum.head(2) / sum[2]); },
        [](const Eigen::VectorXd& sum) { return sum[2] / sum[3]; });
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
                   "mean number of contacts of a particle, those at the free surface included");
    }
    result.add("contact_tolerance", tolerance, "1", "pairs nearer than (1 + tolerance) (r_i + r_j) are in contact");
    result.add("coordination_without_rattlers", coordination.mean_without_rattlers, "1",
               "contacts among the other particles, per particle");
    result.add("rattler_fraction", coordination.rattler_fraction, "1",
               "fraction of particles left with fewer than two contacts when such particles are removed again and again");
    result.add("below_three_fraction", coordination.below_three_fraction, "1",
               "fraction of the particles with fewer than three contacts", error[1]);
}

MeasureResult run(const MeasureInput& input) {
    const Coordination& coordination = input.coordination();
    const double tolerance = input.number("contact-tolerance");
    MeasureResult result;
    add_means(coordination, tolerance, mean_errors(input, coordination.counts), result);
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
    return {
        .name = "coordination", .summary = "contacts per particle, rattlers", .run = run, .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
