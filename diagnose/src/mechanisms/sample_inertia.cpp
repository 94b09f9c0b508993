// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

using Complex = std::complex<double>;

/// x cot x.
Complex times_cotangent(Complex x) {
    const Complex square = x * x;
    return std::abs(x) < 0.1 ? 1.0 - square / 3.0 - square * square / 45.0 : x / std::tan(x);
}

/// Torque at the plate that moves, the other at rest (Schrag 1977): the strain is no longer the same all over the gap.
Complex with_waves(Complex modulus, const Observation& row, Values values) {
    if (!std::isfinite(row.gap) || !std::isfinite(row.angular_frequency) || modulus == 0.0) {
        return modulus;
    }
    return modulus * times_cotangent(row.angular_frequency * row.gap * std::sqrt(values[0] / modulus));
}

/// Somewhere a sample of twice the density of water would lose a thousandth of its modulus.
bool shows_waves(const Knows& knows) {
    constexpr double density = 2000;
    constexpr double visible = 1e-3;
    for (const Measurement& table : knows.experiment.measurements) {
        for (std::size_t row = 0; row < table.rows() && std::isnan(table.cone_angle); ++row) {
            const double own = cell(table, "gap", row);
            const double gap = std::isnan(own) ? knows.experiment.instrument.gap : own;
            const double storage = cell(table, "storage_modulus", row);
            const double size = std::hypot(std::isnan(storage) ? 0.0 : storage, cell(table, "loss_modulus", row));
            if (density * std::pow(angular_frequency(table, row) * gap, 2) / 3 > visible * size) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

Mechanism sample_inertia() {
    return {.name = "sample-inertia",
            .term = "shear waves pass through the sample, because it is soft and the gap is wide",
            .signature =
                "The storage modulus changes in proportion to the square of the frequency and to the square of the "
                "gap, under every plate alike.",
            .kind = {Link::geometry, Axis::frequency},
            .parameters = {{"density", "kg/m3", 500, 8000, true}},
            .effect = ChangesGeometry{with_waves},
            .applies = shows_waves};
}

}  // namespace coagula::diagnose::mechanisms
