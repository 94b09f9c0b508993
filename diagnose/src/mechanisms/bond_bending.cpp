// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism bond_bending() {
    return {.name = "bond-bending",
            .term = "bonds resist bending and twisting",
            .signature = "The moduli are higher, most where the coordination is low.",
            .kind = {Link::material, Axis::coordination},
            .parameters = {{"bending_over_normal", "1", 1e-6, 0.1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.bending_ratio = values[0]; }},
            .applies = [](const Knows& knows) { return knows.moduli; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
