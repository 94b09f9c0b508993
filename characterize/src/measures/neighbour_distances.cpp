// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: distances to the nearest particles.
#include <coagula/characterize/local_structure.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure neighbour_distances_measure();

namespace {

MeasureResult run_neighbour_distances(const MeasureInput& input) {
    const NeighbourDistances found = if_applicable([&] { return measure_neighbour_distances(input.packing()); });
    MeasureResult result;
    result.add_vector("neighbour_distances/mean", found.mean, "m",
                      "mean distance of centres to the nearest, second nearest ... particle");
    add_known(result, "neighbour_distances/mean_stderr", found.mean_stderr, "m",
              "standard error of the mean distances from sub-volumes");
    result.add_vector("neighbour_distances/distance", found.distance, "m", "middle of the bins of the nearest distance");
    result.add_vector("neighbour_distances/density", found.density, "m-1", "H(r): probability density of the nearest distance");
    result.add("neighbour_distances/nearest", found.mean[0], "m", "mean distance to the nearest centre", found.mean_stderr[0]);
    result.add("neighbour_distances/smallest", found.smallest, "m", "smallest distance of two centres", found.smallest_stderr);
    result.add("neighbour_distances/spread", found.spread, "m", "standard deviation of the nearest distance", found.spread_stderr);
    result.add("neighbour_distances/mean_gap", found.mean_gap, "m",
               "mean distance of surfaces to the nearest particle; negative: overlap", found.mean_gap_stderr);
    result.add_line("nearest neighbour", "at " + with_unit(found.mean[0] / (2 * input.r0()), "diameters") + " on average");
    return result;
}

}  // namespace

Measure neighbour_distances_measure() {
    return {.name = "neighbour_distances", .summary = "distances to the nearest particles, H(r)", .run = run_neighbour_distances};
}

}  // namespace coagula::characterize
