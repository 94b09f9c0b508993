// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

bool builds_up_unsheared(const Knows& knows) {
    return knows.clock && !knows.shear_before;
}

}  // namespace

/// A sample that coagulates or sets between the plates, from its filling on: by orders of magnitude within a decade of time.
Mechanism ageing_power() {
    return {.name = "ageing-power",
            .term = "the sample sets: its stiffness grows as a power of its age",
            .signature =
                "The moduli grow by more than a factor of two with the age of the sample, whatever the strain, and go "
                "on growing. 'ageing-saturating' slows down and stops; only the latest times separate the two.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"power_of_age", "1", 0.3, 3, true}, {"power_time", "s", 1, 1e4, true}},
            .effect = ScalesMaterial{power_of_age},
            .applies = builds_up_unsheared};
}

}  // namespace coagula::diagnose::mechanisms
