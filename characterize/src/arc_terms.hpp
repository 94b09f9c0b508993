// Arc terms of the covered volume at many radii, in loops that the compiler turns into vector instructions. Internal.
#pragma once

#include <array>

namespace coagula::characterize {

/// The sides of an edge, with a and b as in ball_orthoscheme.hpp.
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

}  // namespace coagula::characterize
