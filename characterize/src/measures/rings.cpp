// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: shortest-path rings of the contact network.
#include "inner_sums.hpp"
#include "measure_options.hpp"

#include <coagula/characterize/rings.hpp>

namespace coagula::characterize {

Measure rings_measure();

namespace {

/// Rings of size n per particle, from the sums of 1 and of rings through a particle.
Eigen::VectorXd per_particle(const Eigen::VectorXd& sums) {
    Eigen::VectorXd rings = sums.tail(sums.size() - 1) / sums[0];
    for (Index size = 1; size < rings.size(); ++size) {
        rings[size] /= static_cast<double>(size);
    }
    return rings;
}

MeasureResult run_rings(const MeasureInput& input) {
    const auto largest = static_cast<int>(input.count("largest-ring"));
    const Rings rings = measure_rings(input.contacts(), largest, input.progress());
    Eigen::MatrixXd values(rings.per_particle.rows() + 1, rings.per_particle.cols());
    values << Eigen::RowVectorXd::Ones(values.cols()), rings.per_particle.cast<double>();
    const Eigen::VectorXd found = per_particle(sum_inner(input, values));
    const Eigen::VectorXd error = errors_of_means(input, values, per_particle);
    MeasureResult result;
    result.add_vector("rings/per_particle", found, "1", "shortest-path rings of 0, 1, 2 ... particles, per particle");
    if (error.allFinite()) {
        result.add_vector("uncertainty/rings/per_particle", error, "1", "standard error of rings/per_particle");
    }
    result.add_vector("rings/count", rings.count(), "1", "number of shortest-path rings of 0, 1, 2 ... particles");
    result.add_count("rings/largest", largest, "size up to which rings were searched");
    result.add_field("rings", rings.per_particle.colwise().sum().cast<double>(), "1", "shortest-path rings through the particle");
    std::string text;
    for (int size = 3; size <= largest; ++size) {
        text += (size == 3 ? "" : ", ") + with_unit(found[size], "1") + " of " + std::to_string(size);
    }
    result.add_line("rings per particle", text);
    return result;
}

}  // namespace

Measure rings_measure() {
    return {.name = "rings",
            .summary = "shortest-path rings of the contact network (Franzblau)",
            .run = run_rings,
            .options = {contact_tolerance_option(),
                        {"largest-ring", "", "largest number of particles of a ring to search for", 8, 3, 12}}};
}

}  // namespace coagula::characterize
