// SPDX-License-Identifier: GPL-3.0-or-later
// What one oscillation of the stress says: moduli, phase, harmonics.
#pragma once

#include <coagula/mechanics/rheometer.hpp>

#include <span>

namespace coagula::mechanics {

/// Evaluates one oscillation, strain = amplitude x sin(2 pi k / n) at sample k of n.
/// @param stress n samples, the first one at phase 0 [Pa].
Oscillation evaluate_oscillation(std::span<const double> stress, double amplitude);

}  // namespace coagula::mechanics
