// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the exact pore-size curve held against random points.
#include "measure_options.hpp"
#include "optional_results.hpp"

namespace coagula::characterize {

Measure sampled_check_measure();

namespace {

MeasureResult run_sampled_check(const MeasureInput& input) {
    require(input.has("samples"), "the sampled check needs the number of points, samples");
    input.progress().update("sampling", 0.0);
    const SampledCheck check = compare_with_samples(input.packing(), known_pores(input), input.count("samples"), input.seed());
    MeasureResult result;
    result.add("sampled_check/largest_z", check.largest_z, "1",
               "largest |sampled - exact| exclusion probability over its standard error");
    result.add_count("sampled_check/radii", check.radii, "number of radii compared");
    result.add_count("sampled_check/void_points", check.sampled.void_points, "random points that fell into the void space");
    result.add_vector("sampled_check/exclusion_probability", check.sampled.exclusion_probability, "1",
                      "sampled P(r_P > r) at the radii of pore_curve");
    result.add_line("sampled check", "largest |z| " + with_unit(check.largest_z, "1") + " over " + std::to_string(check.radii) +
                                         " radii, " + std::to_string(check.sampled.void_points) + " points");
    return result;
}

}  // namespace

Measure sampled_check_measure() {
    return {.name = "sampled_check",
            .summary = "check of the exact pore-size curve by random points",
            .run = run_sampled_check,
            .options = {radii_option(),
                        pore_tolerance_option(),
                        {"samples", "", "check the exact pore-size curve by this many random points", {}, 100, 1e10}},
            .by_default = false,
            .along = {"pores"},
            .when_given = "samples"};
}

}  // namespace coagula::characterize
