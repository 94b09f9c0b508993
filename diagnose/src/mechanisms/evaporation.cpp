// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double usual_radius = 25e-3;  // m
constexpr double least_volume = 0.2;    // that is left: particles fill the rest

/// The rim loses solvent, in proportion to its area, from the whole volume: 2 / R of it, whatever the gap.
std::complex<double> concentrated(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    if (!std::isfinite(row.time) || row.solvent_trap) {
        return 1;
    }
    const double radius = std::isfinite(row.plate_radius) ? row.plate_radius : usual_radius;
    const double left = std::max(1 - values[0] * row.time * usual_radius / radius, least_volume);
    return std::pow(left, -values[1]);
}

bool dries(const Knows& knows) {
    return knows.clock && knows.experiment.instrument.geometry != Geometry::concentric_cylinders;
}

}  // namespace

/// An open rim of water in a dry room loses 1e-5 to 1e-4 kg/(m2 s): 1e-6 to 1e-5 of the volume a second under plates of 25 mm.
/// G' of colloidal gels grows as the volume fraction to a power of 2 to 6 (Buscall and others 1988).
Mechanism evaporation() {
    return {.name = "evaporation",
            .term = "solvent evaporates at the rim, so that the volume fraction of the whole sample grows",
            .signature =
                "All moduli grow faster and faster with the time since the filling, more under a smaller plate, at "
                "every gap alike. A solvent trap prevents it.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"solvent_loss", "1/s", 1e-7, 1e-4, true}, {"modulus_exponent", "1", 2, 6, false}},
            .effect = ScalesMaterial{concentrated},
            .applies = dries,
            .told_apart = {shows_rim, "fresh samples under a solvent trap or between plates of another radius"}};
}

}  // namespace coagula::diagnose::mechanisms
