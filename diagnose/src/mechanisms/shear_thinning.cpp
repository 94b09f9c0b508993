// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// 1 + excess (1 s-1 / rate)^exponent.
std::complex<double> thinning(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    const auto* viscosity = as<Viscosity>(row);
    return viscosity != nullptr ? 1 + values[0] * std::pow(viscosity->shear_rate, -values[1]) : 1;
}

}  // namespace

/// Sisko's law (Industrial and Engineering Chemistry 50, 1789, 1958) of what is no oil, as a grease: a constant viscosity at high
/// rates, a power of the rate at low ones. At an exponent of 1 it were a stress that stays, as `torque_offset` leaves it.
Mechanism shear_thinning() {
    return {.name = "shear-thinning",
            .term = "the sample is not a Newtonian fluid: its viscosity falls with the shear rate",
            .signature =
                "The viscosity rises towards low shear rates, more slowly than one over the rate, under all plates "
                "alike.",
            .kind = {Link::material, Axis::shear_rate},
            .parameters = {{"excess_at_1_per_s", "1", 1e-3, 10, true}, {"thinning_exponent", "1", 0.1, 0.9, false}},
            .effect = ScalesMaterial{thinning},
            .applies = flows_as_an_oil,
            .in_any_fluid = true};
}

}  // namespace coagula::diagnose::mechanisms
