// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// The range goes from what an air bearing has to a worn one; T = (K G* + i b w) theta (Ewoldt, Johnston and Caretta 2015).
Mechanism bearing_damping() {
    return {.name = "bearing-damping",
            .term = "friction in the instrument's bearing damps the tool in proportion to its speed",
            .signature =
                "The loss modulus gains a part that is proportional to the frequency, in an oil too. The storage "
                "modulus does not change. The effect is smaller under a larger plate.",
            .kind = {Link::tool, Axis::frequency},
            .parameters = {{"damping", "N.m.s", 1e-9, 1e-4, true}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                const double frequency = is<Viscosity>(row) ? 1 : row.angular_frequency;
                return std::isfinite(frequency) ? modulus + std::complex<double>(0, values[0] * frequency / row.torque_per_modulus)
                                                : modulus;
            }},
            .applies = [](const Knows& knows) { return knows.torque && (knows.frequency || knows.flow); }};
}

}  // namespace coagula::diagnose::mechanisms
