// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: angles between the contacts of a particle.
#include <coagula/characterize/local_structure.hpp>

#include "measure_options.hpp"
#include "optional_results.hpp"

#include <numbers>

namespace coagula::characterize {

Measure bond_angles_measure();

namespace {

MeasureResult run_bond_angles(const MeasureInput& input) {
    const BondAngles found = measure_bond_angles(input.packing(), {.contact_tolerance = input.number("contact-tolerance")});
    MeasureResult result;
    result.add_vector("bond_angles/angle", found.angle, "rad",
                      "middle of the bins of the angle between two contacts of a particle");
    result.add_vector("bond_angles/density", found.density, "rad-1",
                      "probability density; independent directions have sin(angle) / 2");
    add_known(result, "bond_angles/density_stderr", found.density_stderr, "rad-1",
              "standard error of the density from sub-volumes");
    result.add_count("bond_angles/angles", found.angles, "number of pairs of contacts");
    add_known(result, "bond_angles/mean", found.mean, "rad", "mean angle", found.mean_stderr);
    add_known(result, "bond_angles/below_65_degrees", found.below_equilateral, "1",
              "fraction of the angles below 65 degrees: triangles of touching particles", found.below_equilateral_stderr);
    if (found.angles > 0) {
        result.add_line("angles of contacts", "mean " + with_unit(found.mean * 180 / std::numbers::pi, "degrees") + ", " +
                                                  with_unit(100 * found.below_equilateral, "%") + " below 65 degrees");
    }
    return result;
}

}  // namespace

Measure bond_angles_measure() {
    return {.name = "bond_angles",
            .summary = "angles between the contacts of a particle",
            .run = run_bond_angles,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
