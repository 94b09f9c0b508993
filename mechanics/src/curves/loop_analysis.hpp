// SPDX-License-Identifier: GPL-3.0-or-later
// Harmonics of a stress that is known at the points of a strain cycle.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

struct Harmonics {
    double in_phase = 0;          ///< coefficient of sin(phase)
    double out_of_phase = 0;      ///< coefficient of cos(phase)
    double third_over_first = 0;  ///< amplitude of the third harmonic over that of the first; 0 without stress
    double area = 0;              ///< integral of stress d strain over the cycle
};

/// Fourier coefficients over strain = amplitude sin(phase), phase from 0 to 2 pi, of a stress that is linear in the strain between
/// the points: exact, so that area = pi amplitude out_of_phase. Points at equal phase are jumps.
Harmonics analyse_loop(double amplitude, const std::vector<double>& phase, const std::vector<double>& stress);

}  // namespace coagula::mechanics
