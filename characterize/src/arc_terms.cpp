#include "arc_terms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#if defined(__x86_64__) && defined(__GNUC__)
#define COAGULA_VARIANTS __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#define COAGULA_INLINE inline __attribute__((always_inline))
#else
#define COAGULA_VARIANTS
#define COAGULA_INLINE inline
#endif

namespace coagula::characterize {

namespace {

/// atan(z) = z + z^3 p(z^2) for |z| <= tan(pi / 8): p interpolates at Chebyshev's points, with an error of 7e-18 in atan(z) / z.
constexpr std::array<double, 11> series = {-0.3333333333333333,   0.19999999999995516, -0.14285714284665682, 0.11111111015187018,
                                           -0.0909090457530649,   0.07692183125376892, -0.06664510525508936, 0.05858140904866328,
                                           -0.050854078345894844, 0.03923044778479309, -0.019175404711104932};

/// atan(p / q) for p, q >= 0, without branches: tan(x - pi / 4) = (tan x - 1) / (tan x + 1), tan(x - pi / 2) = -1 / tan x.
COAGULA_INLINE double arctangent(double p, double q) {
    constexpr double eighth = std::numbers::sqrt2 - 1;  // tan(pi / 8)
    constexpr double three_eighths = std::numbers::sqrt2 + 1;
    constexpr double quarter_turn = std::numbers::pi / 2;
    const bool is_middle = p > eighth * q;
    const bool is_steep = p > three_eighths * q;
    const double upper = is_steep ? -q : (is_middle ? p - q : p);
    const double lower = is_steep ? p : (is_middle ? p + q : q);
    const double offset = is_steep ? quarter_turn : (is_middle ? quarter_turn / 2 : 0.0);
    const double z = upper / std::max(lower, 1e-300);  // 0 / 0 is 0
    const double square = z * z;
    double sum = series[10];
    for (int k = 9; k >= 0; --k) {
        sum = sum * square + series[static_cast<std::size_t>(k)];
    }
    return offset + (z + z * square * sum);
}

/// The same as arc_term of ball_orthoscheme.hpp.
COAGULA_INLINE void add_side(double a, double b, double weight, const double* rho, const double* half_chord, double* sum) {
    for (int k = 0; k < arc_block; ++k) {
        const double theta = arctangent(half_chord[k], b);
        const double psi = arctangent(a * half_chord[k], b * rho[k]);
        const double square = rho[k] * rho[k];
        const double term = a * b * half_chord[k] / 6 - theta * a * (3 * square - a * a) / 6 + psi * square * rho[k] / 3;
        sum[k] += weight * term;
    }
}

}  // namespace

COAGULA_VARIANTS void sum_arc_terms(const ArcSides& sides, double start, double step, int blocks, double* sum) {
    alignas(64) double rho[arc_block];
    alignas(64) double half_chord[arc_block];
    alignas(64) double total[arc_block];
    for (int block = 0; block < blocks; ++block) {
        for (int k = 0; k < arc_block; ++k) {
            rho[k] = start + step * (block * arc_block + k);
            half_chord[k] = std::sqrt(std::max(0.0, (rho[k] - sides.d1) * (rho[k] + sides.d1)));
            total[k] = 0;
        }
        for (std::size_t side = 0; side < 3; ++side) {
            if (sides.weight[side] != 0) {
                add_side(sides.a[side], sides.b[side], sides.weight[side], rho, half_chord, total);
            }
        }
        std::copy_n(total, arc_block, sum + block * arc_block);
    }
}

}  // namespace coagula::characterize
