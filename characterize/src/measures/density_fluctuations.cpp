// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: density fluctuations over sub-volumes.
#include <coagula/characterize/density_fluctuations.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure density_fluctuations_measure();

namespace {

MeasureResult run_density_fluctuations(const MeasureInput& input) {
    const Packing& packing = input.packing();
    const DensityFluctuations found = if_applicable([&] { return measure_density_fluctuations(packing, input.inner()); });
    MeasureResult result;
    result.add_vector("density_fluctuations/edge", found.edge, "m", "edge of the cubic windows");
    result.add_vector("density_fluctuations/deviation", found.deviation, "1",
                      "standard deviation over mean of the solid volume of the particles whose centres lie in the window");
    if (found.deviation_error.allFinite()) {
        result.add_vector("density_fluctuations/deviation_stderr", found.deviation_error, "1", "standard errors from sub-volumes");
    }
    if (std::isfinite(found.integral)) {
        result.add("density_fluctuations/integral", found.integral, "1",
                   "integral of the deviation over the edge in units of r0, from 2 to 10", found.integral_error);
        result.add_line("density fluctuations",
                        with_error(found.integral, found.integral_error) + "   (integral over windows of 2 to 10 r0)");
    } else {
        result.add_line("density fluctuations", "no integral: the sample is too small for windows of 10 r0");
    }
    return result;
}

}  // namespace

Measure density_fluctuations_measure() {
    return {.name = "density_fluctuations",
            .summary = "deviation of the solid volume in cubic windows against their size, and its integral",
            .run = run_density_fluctuations};
}

}  // namespace coagula::characterize
