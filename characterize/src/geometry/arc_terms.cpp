// SPDX-License-Identifier: GPL-3.0-or-later
#include "arc_terms.hpp"

#include <coagula/common/vector_variants.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::characterize {

namespace {

/// atan(z) = z + z^3 p(z^2) for |z| <= tan(pi / 8): p interpolates at Chebyshev's points, with an error of 7e-18 in atan(z) / z.
constexpr std::array<double, 11> series = {-0.3333333333333333,   0.19999999999995516, -0.14285714284665682, 0.11111111015187018,
                                           -0.0909090457530649,   0.07692183125376892, -0.06664510525508936, 0.05858140904866328,
                                           -0.050854078345894844, 0.03923044778479309, -0.019175404711104932};

/// atan(p / q) for p, q >= 0 as offset + atan(upper / lower), without branches: tan(x - pi / 4) = (tan x - 1) / (tan x + 1),
/// tan(x - pi / 2) = -1 / tan x.
struct ReducedArc {
    double offset, upper, lower;
};

COAGULA_INLINE ReducedArc reduce_arc(double p, double q) {
    constexpr double eighth = std::numbers::sqrt2 - 1;  // tan(pi / 8)
    constexpr double three_eighths = std::numbers::sqrt2 + 1;
    constexpr double quarter_turn = std::numbers::pi / 2;
    constexpr double least = 1e-150;  // 0 / 0 is 0
    const bool is_middle = p > eighth * q;
    const bool is_steep = p > three_eighths * q;
    return {is_steep ? quarter_turn : (is_middle ? quarter_turn / 2 : 0.0), is_steep ? -q : (is_middle ? p - q : p),
            std::max(least, is_steep ? p : (is_middle ? p + q : q))};
}

COAGULA_INLINE double finish_arc(double offset, double z) {
    const double square = z * z;
    double sum = series[10];
    for (int k = 9; k >= 0; --k) {
        sum = sum * square + series[static_cast<std::size_t>(k)];
    }
    return offset + (z + z * square * sum);
}

COAGULA_INLINE double arctangent(double p, double q) {
    const ReducedArc arc = reduce_arc(p, q);
    return finish_arc(arc.offset, arc.upper / arc.lower);
}

/// The same as arc_term of ball_orthoscheme.hpp, with one division for both angles.
COAGULA_INLINE void add_side(double a, double b, double weight, const double* rho, const double* half_chord, int count,
                             double* sum) {
#pragma omp simd
    for (int k = 0; k < count; ++k) {
        const ReducedArc theta = reduce_arc(half_chord[k], b);
        const ReducedArc psi = reduce_arc(a * half_chord[k], b * rho[k]);
        const double inverse = 1 / (theta.lower * psi.lower);
        const double square = rho[k] * rho[k];
        const double first = finish_arc(theta.offset, theta.upper * psi.lower * inverse) * a * (3 * square - a * a) * (-1.0 / 6);
        const double second = finish_arc(psi.offset, psi.upper * theta.lower * inverse) * square * rho[k] * (1.0 / 3);
        sum[k] += weight * (a * b * half_chord[k] * (1.0 / 6) + first + second);
    }
}

}  // namespace

COAGULA_VARIANTS OrthoschemeAngles orthoscheme_angles(const ArcSides& sides, const std::array<double, 2>& heights) {
    using Eight = std::array<double, 8>;
    alignas(64) Eight a{}, b{}, c{};
    for (std::size_t k = 0; k < 6; ++k) {
        a[k] = sides.a[k / 2];
        b[k] = sides.b[k / 2];
        c[k] = heights[k % 2];
    }
    OrthoschemeAngles angles;
    double* d2 = angles.d2.data();
    double* phi = angles.phi.data();
    double* psi = angles.psi.data();
#pragma omp simd
    for (int k = 0; k < 8; ++k) {
        d2[k] = std::sqrt(a[k] * a[k] + b[k] * b[k] + c[k] * c[k]);
        phi[k] = arctangent(c[k], b[k]);
        psi[k] = arctangent(a[k] * c[k], b[k] * d2[k]);
    }
    return angles;
}

COAGULA_VARIANTS void sum_arc_terms(const ArcSides& sides, double start, double step, int blocks, double* sum) {
    constexpr int most = 8 * arc_block;
    using Chunk = std::array<double, most>;
    alignas(64) Chunk rho_values;         // NOLINT(cppcoreguidelines-pro-type-member-init): filled chunk by chunk
    alignas(64) Chunk half_chord_values;  // NOLINT(cppcoreguidelines-pro-type-member-init): likewise
    double* rho = rho_values.data();
    double* half_chord = half_chord_values.data();
    for (int begin = 0; begin < blocks * arc_block; begin += most) {
        const int count = std::min(most, blocks * arc_block - begin);
#pragma omp simd
        for (int k = 0; k < count; ++k) {
            rho[k] = start + step * static_cast<double>(begin + k);
            const double squared = (rho[k] - sides.d1) * (rho[k] + sides.d1);
            half_chord[k] = std::sqrt(squared > 0 ? squared : 0.0);
        }
        std::fill_n(sum + begin, static_cast<std::size_t>(count), 0.0);
        for (std::size_t side = 0; side < 3; ++side) {
            if (sides.weight[side] != 0) {
                add_side(sides.a[side], sides.b[side], sides.weight[side], rho, half_chord, count, sum + begin);
            }
        }
    }
}

}  // namespace coagula::characterize
