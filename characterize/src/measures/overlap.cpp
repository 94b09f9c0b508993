// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: overlaps of the spheres.
#include "inner_sums.hpp"

namespace coagula::characterize {

Measure overlap_measure();

namespace {

/// Standard errors of mean, rms, implied noise [m] and largest overlap.
Eigen::Vector4d overlap_errors(const MeasureInput& input) {
    const Packing& packing = input.packing();
    const ContactNetwork contacts = find_contacts(packing, 0);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(5, packing.size());
    values.row(0).setOnes();
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(packing.size());
    for (Index pair = 0; pair < contacts.size(); ++pair) {
        const double touching = packing.radii[contacts.ends(0, pair)] + packing.radii[contacts.ends(1, pair)];
        const double overlap = 1 - contacts.branch.col(pair).norm() / touching;
        for (int end = 0; end < 2; ++end) {
            const int particle = contacts.ends(end, pair);
            values.col(particle).tail<4>() +=
                Eigen::Vector4d(1, overlap, overlap * overlap, overlap * overlap * touching * touching);
            largest[particle] = std::max(largest[particle], overlap);
        }
    }
    const auto means = [](const Eigen::VectorXd& sum) {
        const double pairs = std::max(1.0, sum[1]);
        return Eigen::VectorXd{{sum[2] / pairs, std::sqrt(sum[3] / pairs), std::sqrt(sum[4] / (2 * pairs))}};
    };
    const Eigen::VectorXd error = errors_of_means(input, values, means);
    return {error[0], error[1], error[2], extreme_error(largest_by_block(input.blocks(), largest))};
}

MeasureResult run_overlap(const MeasureInput& input) {
    const Overlaps overlaps = measure_overlaps(input.packing());
    const Eigen::Vector4d error = overlap_errors(input);
    MeasureResult result;
    result.add("overlap/mean", overlaps.mean, "1", "mean overlap of the overlapping pairs over r_i + r_j", error[0]);
    result.add("overlap/rms", overlaps.rms, "1", "root mean square overlap of the overlapping pairs over r_i + r_j", error[1]);
    result.add("overlap/max", overlaps.max, "1", "largest overlap over r_i + r_j", error[3]);
    result.add_count("overlap/pairs", overlaps.pairs, "number of overlapping pairs");
    result.add("overlap/implied_noise", overlaps.implied_noise, "m",
               "error of a coordinate that would explain the overlaps of spheres that just touch: rms overlap / sqrt(2)", error[2]);
    result.add_line("overlap", with_unit(100 * overlaps.rms, "%") + " rms, " + with_unit(100 * overlaps.max, "%") +
                                   " max of the diameter, " + std::to_string(overlaps.pairs) + " pairs");
    return result;
}

}  // namespace

Measure overlap_measure() {
    return {.name = "overlap", .summary = "overlaps of touching spheres", .run = run_overlap};
}

}  // namespace coagula::characterize
