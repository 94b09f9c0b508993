// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the largest sphere that fits into the void, and the largest that can move through it.
#include "measure_options.hpp"
#include "optional_results.hpp"
#include "pore_errors.hpp"
#include "pores/pores_of_diagram.hpp"

namespace coagula::characterize {

Measure free_spheres_measure();

namespace {

std::string in_diameters(double diameter, double r0) {
    return with_unit(diameter, "m") + " = " + with_unit(diameter / (2 * r0), "mean diameters");
}

/// Standard error of D_f, from the scatter of the three axes.
double scatter(const Eigen::Vector3d& by_axis) {
    return std::sqrt((by_axis.array() - by_axis.mean()).square().sum() / 2);
}

void add_free(const FreeSpheres& found, double included_error, double r0, MeasureResult& result) {
    result.add("free_spheres/free", found.free, "m",
               "D_f: diameter of the largest sphere that can move from a place to a periodic image of it; 0: there is no such way",
               scatter(found.free_by_axis));
    result.add_vector("free_spheres/free_by_axis", found.free_by_axis, "m", "D_f of ways along x, y, z");
    result.add_line("largest free sphere D_f", in_diameters(found.free, r0) + ": moves through the packing without end");
    if (std::isfinite(found.included_along_free)) {
        result.add("free_spheres/included_along_free", found.included_along_free, "m",
                   "D_if: diameter of the largest sphere that fits somewhere along the ways of the free sphere", included_error);
        result.add_line("included along its ways D_if", in_diameters(found.included_along_free, r0));
    } else {
        result.add_line("included along its ways D_if", found.free > 0 ? "not known: no straight way leads to the largest pore"
                                                                       : "there are no ways through the packing");
    }
}

MeasureResult run_free_spheres(const MeasureInput& input) {
    const FreeSpheres found = if_applicable([&] { return measure_free_spheres(input.diagram(), input.progress()); });
    const double r0 = input.r0();
    const double included_error = 2 * largest_pore_error(input.pores());
    MeasureResult result;
    result.add("free_spheres/included", found.included, "m", "D_i: diameter of the largest sphere that fits into the void",
               included_error);
    result.add_line("largest included sphere D_i", in_diameters(found.included, r0) + ": fits somewhere in the void");
    if (input.packing().cell.is_periodic()) {
        add_free(found, included_error, r0, result);
    } else {
        result.add_line("largest free sphere D_f", "left out: a packing with a free surface has no way without end");
    }
    return result;
}

}  // namespace

Measure free_spheres_measure() {
    return {.name = "free_spheres",
            .summary = "largest sphere that fits into the void (D_i), and that can move through it without end (D_f, D_if)",
            .run = run_free_spheres,
            .options = {radii_option(), pore_tolerance_option()}};
}

}  // namespace coagula::characterize
