// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_scheme.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

namespace coagula::generators {

namespace {

// A linear mode x' = -lambda x becomes A x + B Q + C R in a step; A, B and C are polynomials of q = lambda dt = (w0 - x)/w1, with
// A = T_s(x)/T_s(w0) and the Chebyshev polynomials T and U of the first and second kind. After the postprocessor of weight c its
// variance is exact if
//   B^2 + C^2 = (1 - A^2) (1/(2 q) - c^2) = c^2/T_s(w0)^2 (w0 + x)^2 P(x),   P = (T_s(w0)^2 - T_s(x)^2)/(w0^2 - x^2),
// with c^2 = w1/(4 w0). P is positive and so a sum of two squares: those of the real and the imaginary part of
//   h(x) = prod_k 2 (x - z_k),   P = |h|^2,
// where z_k, k = 1 ... s - 1, is one of each pair of conjugate roots, cos(k pi/s +- i arcosh w0). Signs in turn make the imaginary
// part small. Without damping h = U_(s-1).

/// Coefficients of h in U_0 ... U_(s-1), from its values at the zeros of U_s.
std::vector<std::complex<double>> complex_root(std::size_t stages, double w0) {
    const double width = std::acosh(w0);
    std::vector<std::complex<double>> coefficients(stages);
    for (std::size_t node = 1; node <= stages; ++node) {
        const double angle = std::numbers::pi * static_cast<double>(node) / static_cast<double>(stages + 1);
        std::complex<double> value = 2 * std::sin(angle) / static_cast<double>(stages + 1);
        for (std::size_t k = 1; k < stages; ++k) {
            const double real = std::numbers::pi * static_cast<double>(k) / static_cast<double>(stages);
            value *= 2.0 * (std::cos(angle) - std::cos(std::complex<double>(real, k % 2 == 0 ? width : -width)));
        }
        for (std::size_t order = 0; order < stages; ++order) {
            coefficients[order] += value * std::sin(static_cast<double>(order + 1) * angle);
        }
    }
    return coefficients;
}

/// Where a noise enters: at the evaluation of the first force and in each stage.
struct Entry {
    double evaluation = 0;
    std::vector<double> stages;
};

/// The entry whose noise ends up as weight (w0 + x) f(x). What enters in stage j goes on as T_j(w0)/T_s(w0) U_(s-j)(x); what enters
/// at the evaluation, as 1/T_s(w0) (x - w0) U_(s-1)(x).
/// @param f its coefficients in U_0 ... U_(s-1). @param value T_0 ... T_s at w0.
Entry entry_for(double weight, const std::vector<double>& f, const std::vector<double>& value) {
    const double w0 = value[1];
    const std::size_t s = f.size();
    std::vector<double> product(s + 1, 0.0);  // x U_m = (U_(m+1) + U_(m-1))/2
    for (std::size_t order = 0; order < s; ++order) {
        product[order] += w0 * f[order];
        product[order + 1] += 0.5 * f[order];
        if (order > 0) {
            product[order - 1] += 0.5 * f[order];
        }
    }
    // The evaluation alone reaches U_s.
    product[s - 1] += w0 * f[s - 1];
    if (s > 1) {
        product[s - 2] -= 0.5 * f[s - 1];
    }
    Entry entry{weight * f[s - 1] * value[s], {}};
    for (std::size_t stage = 1; stage <= s; ++stage) {
        entry.stages.push_back(weight * product[s - stage] * value[s] / value[stage]);
    }
    return entry;
}

void add_noise(StepScheme& scheme, const std::vector<double>& value) {
    std::vector<double> first;
    std::vector<double> second;
    for (const std::complex<double>& coefficient : complex_root(scheme.stages.size(), value[1])) {
        first.push_back(coefficient.real());
        second.push_back(coefficient.imag());
    }
    second.back() = 0;  // the leading coefficient of h is real
    const double weight = scheme.observation / value.back();
    const Entry one = entry_for(weight, first, value);
    const Entry two = entry_for(weight, second, value);
    scheme.evaluation = one.evaluation;
    for (std::size_t stage = 0; stage < scheme.stages.size(); ++stage) {
        scheme.stages[stage].noise = one.stages[stage];
        scheme.stages[stage].second_noise = two.stages[stage];
    }
}

}  // namespace

StepScheme euler_maruyama() {
    StepScheme scheme;
    scheme.stages = {{.force = 1, .previous = 1, .noise = 1}};
    return scheme;
}

StepScheme stabilised_scheme(int stages, double damping) {
    require(stages >= 1, "the number of stages is " + std::to_string(stages) + ", but a step needs at least 1");
    require_non_negative(damping, "the damping of the stabilised step");
    const auto s = static_cast<std::size_t>(stages);
    const double w0 = 1 + damping / (static_cast<double>(stages) * stages);
    std::vector<double> value{1, w0};  // of T_0 ... T_s at w0
    std::vector<double> slope{0, 1};
    for (std::size_t i = 2; i <= s; ++i) {
        value.push_back(2 * w0 * value[i - 1] - value[i - 2]);
        slope.push_back(2 * value[i - 1] + 2 * w0 * slope[i - 1] - slope[i - 2]);
    }
    const double w1 = value[s] / slope[s];
    StepScheme scheme;
    scheme.stages.push_back({.force = w1 / w0, .previous = 1});
    for (std::size_t i = 2; i <= s; ++i) {
        const double current = 2 * w0 * value[i - 1] / value[i];
        scheme.stages.push_back({.force = 2 * w1 * value[i - 1] / value[i], .current = current, .previous = 1 - current});
    }
    // |A| <= 1 down to x = -1.
    scheme.stability = (w0 + 1) / w1;
    scheme.observation = std::sqrt(w1 / (4 * w0));
    add_noise(scheme, value);
    return scheme;
}

}  // namespace coagula::generators
