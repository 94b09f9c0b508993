// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: Minkowski functionals of growing spheres.
#include <coagula/characterize/minkowski.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure minkowski_measure();

namespace {

MeasureResult run_minkowski(const MeasureInput& input) {
    const Minkowski found = if_applicable(
        [&] { return measure_minkowski(input.packing(), {.dilations = input.count("dilations")}, input.progress()); });
    MeasureResult result;
    result.add_vector("minkowski/dilation", found.dilation, "m", "added to all radii");
    result.add_vector("minkowski/volume_fraction", found.volume_fraction, "1",
                      "volume of the union of the spheres over the volume measured");
    result.add_vector("minkowski/surface", found.surface, "m-1", "surface of the union over the volume");
    result.add_vector("minkowski/mean_curvature", found.mean_curvature, "m-2",
                      "integral of the mean curvature of the union's surface over the volume");
    result.add_vector("minkowski/euler_characteristic", found.euler_characteristic, "m-3",
                      "Euler characteristic of the union (parts - tunnels + cavities) over the volume");
    result.add("minkowski/undilated/volume_fraction", found.volume_fraction[0], "1", "volume fraction at dilation 0",
               found.volume_fraction_stderr);
    result.add("minkowski/undilated/surface", found.surface[0], "m-1", "surface per volume at dilation 0", found.surface_stderr);
    result.add("minkowski/undilated/mean_curvature", found.mean_curvature[0], "m-2",
               "integrated mean curvature per volume at dilation 0", found.mean_curvature_stderr);
    result.add("minkowski/undilated/euler_characteristic", found.euler_characteristic[0], "m-3",
               "Euler characteristic per volume at dilation 0", found.euler_characteristic_stderr);
    add_known(result, "minkowski/percolation_dilation", found.percolation_dilation, "m",
              "dilation at which the Euler characteristic first passes zero", found.percolation_dilation_stderr);
    result.add_line("surface of the spheres", with_unit(found.surface[0] * input.r0(), "1/r0"));
    return result;
}

}  // namespace

Measure minkowski_measure() {
    return {.name = "minkowski",
            .summary = "volume, surface, mean curvature and Euler characteristic of the spheres as they grow, exact",
            .run = run_minkowski,
            .options = {{"dilations", "", "number of dilations of the Minkowski functionals; 0: 60 for equal spheres, else 20", 0,
                         0, 10000}}};
}

}  // namespace coagula::characterize
