// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// 1 + growth (1 - exp(-age / time)).
std::complex<double> saturating(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    return std::isfinite(row.age) ? 1 - values[0] * std::expm1(-row.age / values[1]) : 1;
}

}  // namespace

/// A reaction of first order in what is left to bond: gelation, setting. One that took less than a minute would be over before the
/// first row; and a sweep down in frequency, of rows of equal duration, would show the inertia of the tool as the same exponential.
Mechanism ageing_saturating() {
    return {.name = "ageing-saturating",
            .term = "the sample sets: its stiffness approaches a final value exponentially in its age",
            .signature = "The moduli grow with the age of the sample, whatever the strain, and reach a final value.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"growth", "1", 0.3, 1000, true}, {"setting_time", "s", 60, 1e5, true}},
            .effect = ScalesMaterial{saturating},
            .applies = [](const Knows& knows) { return knows.clock; }};
}

}  // namespace coagula::diagnose::mechanisms
