// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Where the sample fills R + e and R is stated, the torque is that of another radius.
std::complex<double> filled(std::complex<double> modulus, const Observation& row, Values values) {
    const double power = std::isfinite(row.cone_angle) ? 3 : 4;
    return std::isfinite(row.plate_radius) ? modulus * std::pow(1 + values[0] / row.plate_radius, power) : modulus;
}

bool differ_in_radius(const Experiment& experiment) {
    return differs(experiment, [&](const Measurement& table, std::size_t row) {
        const double own = cell(table, "plate_radius", row);
        return std::isnan(own) ? experiment.instrument.plate_radius : own;
    });
}

/// Alone it is a level: plates of several radii show it, or a modulus that is known.
bool shows_radius(const Knows& knows) {
    return knows.radius && (differ_in_radius(knows.experiment) || knows.level);
}

}  // namespace

/// A sample trimmed too little or too much, by up to a millimetre.
Mechanism radius_error() {
    return {.name = "radius-error",
            .term = "the sample reaches beyond the rim of the plates, or ends before it",
            .signature =
                "All moduli are higher or lower by one factor, at every gap alike and more under a smaller plate. An "
                "oil shows it too. The factor differs from filling to filling.",
            .kind = {Link::geometry, Axis::radius},
            .parameters = {{"radius_error", "m", -1e-3, 1e-3, false}},
            .effect = ChangesGeometry{filled},
            .applies = shows_radius,
            // Two plates with samples of their own differ by what the samples do.
            .told_apart = {[](const Knows& knows) { return radii_differ(knows) && shows_oil(knows); },
                           "an oil of known viscosity between the same plates"}};
}

}  // namespace coagula::diagnose::mechanisms
