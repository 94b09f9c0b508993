// What a tool feels of the sample.
#pragma once

#include "observables/observations.hpp"

#include <cmath>
#include <numbers>

namespace coagula::diagnose {

/// Torque per angle over the modulus under a plate or cone [m^3]; NaN where its size is not known.
inline double torque_per_modulus(const Observation& row) {
    using std::numbers::pi;
    const double radius = row.plate_radius;
    return std::isfinite(row.cone_angle) ? 2 * pi * std::pow(radius, 3) / (3 * row.cone_angle)
                                         : pi * std::pow(radius, 4) / (2 * row.gap);
}

}  // namespace coagula::diagnose
