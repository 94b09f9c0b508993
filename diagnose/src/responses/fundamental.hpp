// SPDX-License-Identifier: GPL-3.0-or-later
// The first harmonic of a stress that depends on the momentary strain.
#pragma once

#include <cmath>
#include <numbers>
#include <type_traits>

namespace coagula::diagnose {

/// Mean of f(strain), stress over strain, over a quarter of an oscillation of this amplitude with the weights of 4/pi sin^2.
template <class Function>
auto fundamental(double amplitude, const Function& f) {
    constexpr int phases_of_quarter = 24;
    std::decay_t<decltype(f(amplitude))> sum = 0 * f(amplitude);
    for (int k = 0; k < phases_of_quarter; ++k) {
        const double sine = std::sin(0.5 * std::numbers::pi * (k + 0.5) / phases_of_quarter);
        sum += 2.0 / phases_of_quarter * sine * sine * f(amplitude * sine);
    }
    return sum;
}

}  // namespace coagula::diagnose
