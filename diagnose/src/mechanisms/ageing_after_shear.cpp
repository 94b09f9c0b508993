// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// Cement and clay pastes gain orders of magnitude within minutes after mixing (Roussel, Cement and Concrete Research 36 (2006)
/// 1797, has them linear in time), far beyond the logarithm of a gel that is old.
Mechanism ageing_after_shear() {
    return {.name = "ageing-after-shear",
            .term =
                "shear before the run destroyed structure, which builds up again: the stiffness grows as a power of "
                "the time since then",
            .signature = "The moduli follow the time since the shear, not the strain, over orders of magnitude.",
            .kind = {Link::history, Axis::age},
            .parameters = {{"build_up_exponent", "1", 0.1, 3, true}, {"build_up_time", "s", 1, 1000, true}},
            .effect = ScalesMaterial{power_of_age},
            .applies = [](const Knows& knows) { return knows.shear_before; }};
}

}  // namespace coagula::diagnose::mechanisms
