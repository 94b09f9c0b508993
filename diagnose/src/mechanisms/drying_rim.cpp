// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// A skin of this stiffness around the rim shears with the sample: its torque is 2 pi S R^3 / h per angle between plates, and
/// 2 pi S R^2 / angle under a cone.
std::complex<double> with_skin(std::complex<double> modulus, const Observation& row, Values values) {
    if (!std::isfinite(row.time) || !std::isfinite(row.plate_radius) || row.solvent_trap || is_fluid(row) || is<Viscosity>(row)) {
        return modulus;
    }
    const double moment = std::isfinite(row.cone_angle) ? 3 : 4;
    return modulus + moment * values[0] * row.time / row.plate_radius;
}

bool has_open_rim(const Knows& knows) {
    return knows.radius && knows.clock;
}

}  // namespace

/// The range goes from films that a water-based sample shows within an hour (0.01 N/m) to crusts of a slurry.
Mechanism drying_rim() {
    return {.name = "drying-rim",
            .term = "a skin dries at the rim and is sheared with the sample",
            .signature =
                "The storage modulus grows with time by the same amount at all frequencies, strains and gaps, and by "
                "more under a smaller plate. The loss modulus does not change. A solvent trap prevents it.",
            .kind = {Link::geometry, Axis::time},
            .parameters = {{"skin_growth", "N/(m.s)", 1e-7, 1, true}},
            .effect = ChangesGeometry{with_skin},
            .applies = has_open_rim,
            .told_apart = {shows_rim, "fresh samples under a solvent trap or between plates of another radius"}};
}

}  // namespace coagula::diagnose::mechanisms
