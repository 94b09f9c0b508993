// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// At one frequency bonds of any law break at one force, which is bond-strength.
bool sweeps_strain_at_two_rates(const Knows& knows) {
    return differs(knows.experiment, [](const Measurement& table, std::size_t row) {
        return varies(table, "strain") ? angular_frequency(table, row) : unset;
    });
}

}  // namespace

/// The force is kT / x ln(rate x / (kT k)), x the width of the barrier and k the rate at which bonds open by themselves (Bell,
/// Science 200 (1978) 618; Evans and Ritchie, Biophysical Journal 72 (1997) 1541). Over a decade it grows by 2.3 kT over the part
/// of the barrier that is left to heat at 1 Hz: 5 to 80 kT.
Mechanism activated_rupture() {
    return {.name = "activated-rupture",
            .term =
                "thermal energy helps bonds to break, so that the force they bear grows with the logarithm of the "
                "frequency",
            .signature =
                "The bonds yield, at a strain that grows with the logarithm of the frequency. At one frequency this "
                "looks like 'bond-strength'; a strain sweep at a second frequency separates the two.",
            .kind = {Link::material, Axis::strain},
            .parameters = {{"activated_critical_strain", "1", 3e-6, 3e-2, true, strength_step},
                           {"strength_per_decade", "1", 0.03, 0.5, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) {
                settings.critical_strain = std::min(settings.critical_strain, values[0]);
                settings.strength_per_decade = values[1];
            }},
            .applies = sweeps_strain_at_two_rates,
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
