// SPDX-License-Identifier: GPL-3.0-or-later
// Arc terms of the covered volume at many radii, in loops that the compiler turns into vector instructions. Internal.
#pragma once

#include <array>

namespace coagula::characterize {

/// The sides of an edge, with a >= 0 and b as in ball_orthoscheme.hpp.
struct ArcSides {
    std::array<double, 3> a{};
    std::array<double, 3> b{};       ///< >= 0
    std::array<double, 3> weight{};  ///< 0: the side does not count
    double d1 = 0;                   ///< sqrt(a^2 + b^2), the same for each
};

/// Radii that sum_arc_terms works on at once.
constexpr int arc_block = 8;

/// sum[k] = sum over the sides of weight times arc_term(a, b, rho) at rho = start + k step, for `blocks` times arc_block radii.
void sum_arc_terms(const ArcSides& sides, double start, double step, int blocks, double* sum);

/// The six orthoschemes around an edge: those of side k with the heights c[0] and c[1] have the places 2 k and 2 k + 1.
struct OrthoschemeAngles {
    std::array<double, 8> d2{};   ///< sqrt(a^2 + b^2 + c^2)
    std::array<double, 8> phi{};  ///< atan(c / b)
    std::array<double, 8> psi{};  ///< atan(a c / (b d2))
};

/// @param heights c of the two ends, >= 0.
OrthoschemeAngles orthoscheme_angles(const ArcSides& sides, const std::array<double, 2>& heights);

}  // namespace coagula::characterize
