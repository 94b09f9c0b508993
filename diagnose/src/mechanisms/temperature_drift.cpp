// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// exp(difference exp(-time / settling)).
std::complex<double> drifting(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    return std::isfinite(row.time) ? std::exp(values[0] * std::exp(-row.time / values[1])) : 1;
}

}  // namespace

/// The viscosity of water falls by 2 % a kelvin, that of oils by up to 10 %; plates need minutes to reach their temperature.
Mechanism temperature_drift() {
    return {.name = "temperature-drift",
            .term = "the sample was filled at another temperature than that of the plates and takes on theirs with time",
            .signature =
                "All moduli begin higher or lower by one factor, which decays with the time since the filling. An oil "
                "shows it too.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"start_difference", "1", -0.3, 0.3, false}, {"settling_time", "s", 60, 3000, true}},
            .effect = ScalesMaterial{.factor = drifting, .in_oil = true},
            .applies = [](const Knows& knows) { return knows.clock; },
            .told_apart = {shows_oil, "an oil that is filled as the sample is"},
            .in_any_fluid = true};
}

}  // namespace coagula::diagnose::mechanisms
