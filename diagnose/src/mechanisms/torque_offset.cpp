// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double usual_radius = 25e-3;  // m
constexpr double least_offset = 1e-4;   // Pa: 2.5 nN m, about the least torque that instruments state

/// One torque is the less stress the wider the plate, as one over the cube of its radius.
std::complex<double> with_offset(std::complex<double> modulus, const Observation& row, Values values) {
    const auto* viscosity = as<Viscosity>(row);
    if (viscosity == nullptr) {
        return modulus;
    }
    const double radius = std::isfinite(row.plate_radius) ? row.plate_radius : usual_radius;
    const double stress = values[0] * std::pow(usual_radius / radius, 3);
    return modulus + std::complex<double>(0, stress / viscosity->shear_rate);
}

}  // namespace

/// From nanonewton metres, which a mapped bearing leaves, to more than a micronewton metre of friction or of a rim that the sample
/// wets unevenly (Johnston and Ewoldt 2013). It does not oscillate, and so drops out of moduli.
Mechanism torque_offset() {
    return {.name = "torque-offset",
            .term = "a constant torque that does not come from the sample remains, however slowly the tool turns",
            .signature =
                "Towards low shear rates the viscosity rises, or falls through zero, as one over the rate, most under "
                "small plates.",
            .kind = {Link::tool, Axis::strain},
            .parameters = {{"stress_offset", "Pa", -0.1, 0.1, false, 0, least_offset}},
            .effect = ChangesTool{with_offset},
            .applies = flows_as_an_oil};
}

}  // namespace coagula::diagnose::mechanisms
