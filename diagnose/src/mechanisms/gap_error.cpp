// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double narrowest = 0.1;  ///< gap over the stated one: plates do not meet

}  // namespace

/// Parallelism and zero make it larger by 10 to 60 um as a rule (Kramer, Davies and Stokes 2008); 430 um have been seen. A zero
/// taken warm or on a film makes it smaller (rheometers' manuals).
Mechanism gap_error() {
    return {.name = "gap-error",
            .term = "the true gap differs from the stated one",
            .signature =
                "All moduli are lower by one factor where the true gap is larger, most at small gaps. A Newtonian oil "
                "shows it too.",
            .kind = {Link::geometry, Axis::gap},
            .parameters = {{"gap_error", "m", -5e-5, 5e-4, false, 0, 5e-5}},
            .effect = ChangesGeometry{[](std::complex<double> modulus, const Observation& row, Values values) {
                return std::isfinite(row.gap) ? modulus * row.gap / std::max(row.gap + values[0], narrowest * row.gap) : modulus;
            }},
            .applies = [](const Knows& knows) { return knows.gap && knows.geometry; },
            // A sample may slip by a length that its modulus does not set, or be another at another gap.
            .told_apart = {[](const Knows& knows) { return gaps_differ(knows) && shows_oil(knows); },
                           "an oil of known viscosity at the same gaps"}};
}

}  // namespace coagula::diagnose::mechanisms
