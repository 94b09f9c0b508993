// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

Mechanism tool_inertia() {
    return {.name = "tool-inertia",
            .term = "the inertia of the tool is larger than the instrument corrects for",
            .signature =
                "The storage modulus changes in proportion to the square of the frequency. The loss modulus never "
                "changes.",
            .kind = {Link::tool, Axis::frequency},
            .parameters = {{"inertia", "kg.m2", 1e-9, 1e-3, true}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                const double frequency = row.angular_frequency;
                return std::isfinite(frequency) ? modulus - values[0] * frequency * frequency / row.torque_per_modulus : modulus;
            }},
            .applies = [](const Knows& knows) { return knows.torque && knows.frequency; }};
}

}  // namespace coagula::diagnose::mechanisms
