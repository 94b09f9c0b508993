// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: pore sizes after Gelb and Gubbins.
#include "measure_options.hpp"
#include "optional_results.hpp"
#include "pores/pores_of_diagram.hpp"

namespace coagula::characterize {

Measure gelb_gubbins_measure();

namespace {

MeasureResult run_gelb_gubbins(const MeasureInput& input) {
    const double r0 = input.r0();
    const CoveringOptions options{.points = input.count("covering-points"), .seed = input.seed()};
    const CoveringSpheres found =
        if_applicable([&] { return measure_covering_spheres(input.diagram(), options, input.blocks(), input.progress()); });
    MeasureResult result;
    result.add("gelb_gubbins/mean", found.mean / r0, "1",
               "mean over the void of the radius of the largest sphere that covers a point and enters no particle, over r0",
               found.mean_stderr / r0);
    result.add("gelb_gubbins/spread", found.spread / r0, "1", "standard deviation of that radius over r0",
               found.spread_stderr / r0);
    result.add("gelb_gubbins/sampling_error", found.sampling_error / r0, "1",
               "part of the standard error of the mean that comes from the number of points");
    result.add_count("gelb_gubbins/points", found.points, "random points in the void");
    result.add_vector("gelb_gubbins/radius", found.radius, "m", "radius r");
    result.add_vector("gelb_gubbins/exceeding", found.exceeding, "1",
                      "fraction of the void covered by spheres of a radius above r");
    if (found.exceeding_stderr.allFinite()) {
        result.add_vector("gelb_gubbins/exceeding_stderr", found.exceeding_stderr, "1", "standard errors from sub-volumes");
    }
    result.add_line("pores after Gelb-Gubbins", "mean radius " + with_error(found.mean / r0, found.mean_stderr / r0) +
                                                    " r0: largest sphere in the void that covers a point");
    return result;
}

}  // namespace

Measure gelb_gubbins_measure() {
    return {.name = "gelb_gubbins",
            .summary = "pore sizes after Gelb and Gubbins: the largest sphere in the void that covers a point, sampled",
            .run = run_gelb_gubbins,
            .options = {{"covering-points", "", "random points in the box at which covering spheres are sought", 20000, 100, 1e8}}};
}

}  // namespace coagula::characterize
