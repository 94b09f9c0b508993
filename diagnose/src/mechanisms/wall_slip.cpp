// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

using Complex = std::complex<double>;

/// Slip under a cone, where the gap grows with the radius: 3 times the integral of u^3 / (u + x) over 0 < u < 1, by which the
/// torque is the smaller. x is the displacement at both walls over the sample's own, at the rim.
Complex sticking_share(Complex x) {
    if (std::abs(x) < 50) {
        return 1.0 - 1.5 * x + 3.0 * x * x - (x == 0.0 ? 0.0 : 3.0 * x * x * x * std::log(1.0 + 1.0 / x));
    }
    Complex share = 0;  // the same for large x, where the terms above cancel
    Complex power = 1;
    for (int k = 1; k <= 10; ++k) {
        power /= x;
        share += (k % 2 == 1 ? 3.0 : -3.0) / (k + 3.0) * power;
    }
    return share;
}

/// With a displacement of the sample at each wall of so much [m/Pa] times the stress there. Nothing slips on rough plates, and no
/// Newtonian fluid does.
Complex slipping(Complex modulus, const Observation& row, Values values) {
    if (row.rough_plates || is_fluid(row) || is<Viscosity>(row)) {
        return modulus;
    }
    if (std::isfinite(row.cone_angle)) {
        const double rim = row.cone_angle * row.plate_radius;
        return std::isfinite(rim) ? modulus * sticking_share(2.0 * values[0] * modulus / rim) : modulus;
    }
    return std::isfinite(row.gap) ? modulus / (1.0 + 2.0 * values[0] * modulus / row.gap) : modulus;
}

bool can_slip(const Knows& knows) {
    return knows.walls && knows.geometry && knows.experiment.material.kind != MaterialKind::newtonian;
}

bool shows_walls(const Knows& knows) {
    return gaps_differ(knows) || any_measurement(knows.experiment, [](const Measurement& table) { return table.rough_plates; });
}

}  // namespace

Mechanism wall_slip() {
    return {.name = "wall-slip",
            .term = "the sample slips at the plates",
            .signature = "The apparent modulus is lower, the more so the stiffer the sample and the smaller the gap.",
            .kind = {Link::geometry, Axis::gap},
            .parameters = {{"slip_length_over_modulus", "m/Pa", 1e-12, 1e-7, true}},
            .effect = ChangesGeometry{slipping},
            .applies = can_slip,
            .told_apart = {shows_walls, "fresh samples at two other gaps or between rough plates"}};
}

}  // namespace coagula::diagnose::mechanisms
