// SPDX-License-Identifier: GPL-3.0-or-later
#include "loop_analysis.hpp"

#include <cmath>
#include <numbers>

namespace coagula::mechanics {

namespace {

/// Antiderivatives of (1, sin x) times (sin x, cos x, sin 3x, cos 3x).
Eigen::Matrix<double, 2, 4> antiderivatives(double x) {
    Eigen::Matrix<double, 2, 4> values;
    values << -std::cos(x), std::sin(x), -std::cos(3 * x) / 3, std::sin(3 * x) / 3,  //
        0.5 * x - 0.25 * std::sin(2 * x), 0.5 * std::sin(x) * std::sin(x), 0.25 * std::sin(2 * x) - 0.125 * std::sin(4 * x),
        0.25 * std::cos(2 * x) - 0.125 * std::cos(4 * x);
    return values;
}

}  // namespace

Harmonics analyse_loop(double amplitude, const std::vector<double>& phase, const std::vector<double>& stress) {
    Eigen::Matrix<double, 1, 4> sum = Eigen::Matrix<double, 1, 4>::Zero();
    Harmonics found;
    for (std::size_t k = 0; k + 1 < phase.size(); ++k) {
        const double from = std::sin(phase[k]);
        const double change = std::sin(phase[k + 1]) - from;
        const double slope = std::abs(change) > 1e-12 ? (stress[k + 1] - stress[k]) / change : 0.0;
        const Eigen::Matrix<double, 1, 2> line(stress[k] - slope * from, slope);
        sum += line * (antiderivatives(phase[k + 1]) - antiderivatives(phase[k]));
        found.area += 0.5 * amplitude * (stress[k] + stress[k + 1]) * change;
    }
    sum /= std::numbers::pi;
    found.in_phase = sum[0];
    found.out_of_phase = sum[1];
    const double first = std::hypot(sum[0], sum[1]);
    found.third_over_first = first > 0 ? std::hypot(sum[2], sum[3]) / first : 0.0;
    return found;
}

}  // namespace coagula::mechanics
