// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

std::complex<double> settling(const Observation& row, Values values, const SimulatedSample& sample) {
    return std::isfinite(row.time) ? settled_layers(row, -values[0] * std::expm1(-row.time / values[1]), sample) : 1;
}

bool settles_in_time(const Knows& knows) {
    return can_settle_between_plates(knows) && knows.clock;
}

}  // namespace

Mechanism sedimentation() {
    return {.name = "sedimentation",
            .term =
                "the sample settles while it is measured, until its volume fraction grows downwards between the "
                "plates",
            .signature =
                "All moduli fall with the time since the filling and level off. The fall is proportional to the "
                "square of the gap.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"settled_difference", "1", 0, 0.05, false}, {"sedimentation_time", "s", 300, 1e5, true}},
            .effect = ScalesMaterial{settling},
            .applies = settles_in_time,
            .told_apart = {gaps_differ, "fresh samples at two other gaps"}};
}

}  // namespace coagula::diagnose::mechanisms
