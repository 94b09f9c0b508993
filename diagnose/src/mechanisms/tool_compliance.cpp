// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism tool_compliance() {
    return {.name = "tool-compliance",
            .term = "the tool deforms more than the instrument corrects for",
            .signature = "The apparent storage modulus of a stiff sample approaches an upper limit.",
            .kind = {Link::tool, Axis::radius},
            .parameters = {{"compliance", "rad/(N.m)", 5e-4, 1e-2, true}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                if (is<Viscosity>(row)) {
                    return modulus;
                }
                return modulus / (1.0 + values[0] * row.torque_per_modulus * modulus);
            }},
            .applies = [](const Knows& knows) { return knows.torque && knows.geometry; }};
}

}  // namespace coagula::diagnose::mechanisms
