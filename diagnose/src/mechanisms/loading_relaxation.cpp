// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// 1 + excess exp(-time / relaxation).
std::complex<double> relaxed(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    return std::isfinite(row.time) ? 1 + values[0] * std::exp(-row.time / values[1]) : 1;
}

/// A shear that destroys the structure takes the load with it. A normal force that was recorded says what the load does.
bool rests_after_filling(const Knows& knows) {
    return knows.clock && !knows.shear_before && !knows.load;
}

}  // namespace

/// Normal forces of 0.1 to 10 N are left by closing the gap and fall over minutes to hours. The modulus follows them as its cube
/// root at most, by tens of per cent (Digby 1981, see normal_load.cpp).
Mechanism loading_relaxation() {
    return {.name = "loading-relaxation",
            .term = "closing the gap left the contacts under a load, which stiffens them and relaxes with time",
            .signature =
                "All moduli of the sample fall with the time since the filling and level off; those of an oil do not. "
                "A recorded normal force falls too.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"excess", "1", 0.01, 1, true}, {"relaxation_time", "s", 10, 1e4, true}},
            .effect = ScalesMaterial{relaxed},
            .applies = rests_after_filling};
}

}  // namespace coagula::diagnose::mechanisms
