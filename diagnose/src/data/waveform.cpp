// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/waveform.hpp>

#include "table_cells.hpp"

#include <coagula/common/dense.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

constexpr int harmonics = 5;
constexpr Index unknowns = 2 * harmonics + 1;
constexpr double least_range = 0.9 * 2 * std::numbers::pi;  ///< of angular frequency times time
constexpr double least_error = 2e-3;  ///< of a third harmonic over the first: what instruments add to it themselves
constexpr double still = 1e-12;       ///< first harmonic over the largest value below which nothing oscillates

/// The amplitude of a harmonic from the coefficients of its sine and cosine: that of exp(i k w t) of which the signal is the
/// imaginary part.
Complex amplitude(const Eigen::VectorXd& coefficients, Index order) {
    return {coefficients[2 * order - 1], coefficients[2 * order]};
}

}  // namespace

std::optional<WaveformHarmonics> harmonics_of(const Measurement& waveform) {
    std::vector<Eigen::Vector3d> samples;  // phase, strain, stress
    double frequency = unset;
    for (std::size_t row = 0; row < waveform.rows(); ++row) {
        const double here = cell(waveform, "angular_frequency", row);
        const Eigen::Vector3d sample(here * cell(waveform, "time", row), cell(waveform, "strain", row),
                                     cell(waveform, "stress", row));
        if (sample.allFinite()) {
            samples.push_back(sample);
            frequency = here;
        }
    }
    const auto count = static_cast<Index>(samples.size());
    if (count < unknowns || samples.back()[0] - samples.front()[0] < least_range) {
        return std::nullopt;
    }
    Eigen::MatrixXd waves(count, unknowns);
    Eigen::MatrixXd signals(count, 2);
    for (Index k = 0; k < count; ++k) {
        const Eigen::Vector3d& sample = samples[static_cast<std::size_t>(k)];
        waves(k, 0) = 1;
        for (int order = 1; order <= harmonics; ++order) {
            const Index cosine = Index{2} * order;
            waves(k, cosine - 1) = std::sin(order * sample[0]);
            waves(k, cosine) = std::cos(order * sample[0]);
        }
        signals.row(k) = sample.tail<2>().transpose();
    }
    const dense::LeastSquares fit(waves, signals);
    if (fit.rank < unknowns) {
        return std::nullopt;
    }
    const Eigen::MatrixXd& coefficients = fit.solution;
    const Complex strain = amplitude(coefficients.col(0), 1);
    const Complex stress = amplitude(coefficients.col(1), 1);
    const Eigen::RowVectorXd largest = signals.cwiseAbs().colwise().maxCoeff();
    if (!(std::abs(strain) > still * largest[0] && std::abs(stress) > still * largest[1])) {
        return std::nullopt;
    }
    const Complex modulus = stress / strain;
    const Complex third = amplitude(coefficients.col(1), 3) / std::abs(stress) * std::pow(std::abs(strain) / strain, 3);
    const double even = std::hypot(std::abs(amplitude(coefficients.col(1), 2)), std::abs(amplitude(coefficients.col(1), 4)));
    return WaveformHarmonics{.strain = std::abs(strain),
                             .angular_frequency = frequency,
                             .storage_modulus = modulus.real(),
                             .loss_modulus = modulus.imag(),
                             .third_harmonic = std::abs(third),
                             .third_harmonic_storage = third.real(),
                             .third_harmonic_loss = third.imag(),
                             .error = std::hypot(0.5 * even / std::abs(stress), least_error)};
}

}  // namespace coagula::diagnose
