// The springpot beside the springs of every contact.
#pragma once

#include <coagula/diagnose/settings.hpp>

#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {

/// Its complex stiffness over that of the spring. In the same proportion to both springs it scales the whole stiffness matrix.
inline std::complex<double> springpot(const Settings& settings, double angular_frequency) {
    const std::complex<double> cycles(0, angular_frequency / (2 * std::numbers::pi));
    return settings.springpot_ratio * std::pow(cycles, settings.springpot_exponent);
}

}  // namespace coagula::diagnose
