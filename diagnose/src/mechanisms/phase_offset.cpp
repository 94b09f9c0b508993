// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Up to a degree: of what an instrument is calibrated to, and what its corrections leave at high frequencies.
Mechanism phase_offset() {
    return {.name = "phase-offset",
            .term = "the instrument reads the phase with an offset",
            .signature =
                "G'' of a stiff solid is a fixed fraction of G', positive or negative, at all frequencies, strains "
                "and times.",
            .kind = {Link::tool, Axis::level},
            .parameters = {{"phase", "rad", -0.02, 0.02, false}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                return is<Viscosity>(row) ? modulus : modulus * std::polar(1.0, values[0]);
            }},
            .applies = [](const Knows& knows) {
                return any_measurement(knows.experiment,
                                       [](const Measurement& table) { return find_column(table, "loss_modulus") != nullptr; });
            }};
}

}  // namespace coagula::diagnose::mechanisms
