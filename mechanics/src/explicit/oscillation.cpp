// SPDX-License-Identifier: GPL-3.0-or-later
#include "oscillation.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace coagula::mechanics {

namespace {

/// Complex amplitude of a harmonic: real in phase with sin, imaginary ahead of it by a quarter.
std::complex<double> harmonic(std::span<const double> values, int order) {
    std::complex<double> sum = 0;
    const auto count = static_cast<double>(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double angle = 2 * std::numbers::pi * order * static_cast<double>(k) / count;
        sum += values[k] * std::complex<double>(std::sin(angle), std::cos(angle));
    }
    return sum * (2 / count);
}

}  // namespace

Oscillation evaluate_oscillation(std::span<const double> stress, double amplitude) {
    Oscillation result;
    result.amplitude = amplitude;
    result.offset = std::accumulate(stress.begin(), stress.end(), 0.0) / static_cast<double>(stress.size());
    double peak = 0;
    for (const double value : stress) {
        peak = std::max(peak, std::abs(value - result.offset));
    }
    const std::complex<double> first = harmonic(stress, 1);
    const double size = std::abs(first);
    result.phase = size > 0 ? std::arg(first) : 0.0;
    result.storage_modulus = peak / amplitude * std::cos(result.phase);
    result.loss_modulus = peak / amplitude * std::sin(result.phase);
    result.fundamental_storage = first.real() / amplitude;
    result.fundamental_loss = first.imag() / amplitude;
    result.third_harmonic = size > 0 ? std::abs(harmonic(stress, 3)) / size : 0.0;
    return result;
}

}  // namespace coagula::mechanics
