// SPDX-License-Identifier: GPL-3.0-or-later
#include "population_curve.hpp"

#include <coagula/common/dense.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::ArrayXd;
using Eigen::Index;

/// Nodes on either side over which the scatter of the curves is pooled.
constexpr Index pooled_neighbours = 4;
/// Length of the Gaussian processes, in the logarithm of the load. For 16 structures of 400 particles the marginal likelihood
/// of the rate of loss is largest at 1.2 and less by 1.2, 5.5 and 12 at 0.8, 0.5 and 0.3; the shorter length leaves more open.
constexpr double length = 0.8;
constexpr double rate_amplitude = 1;
constexpr double ratio_amplitude = 0.3;
constexpr double least_rate = 0.01;    ///< for the errors of nodes up to which nothing has broken
constexpr double least_noise = 0.05;   ///< of an energy ratio
constexpr double unknown = 10;         ///< noise of one where nothing breaks
constexpr double still_intact = 1e-6;  ///< least modulus left
constexpr double visible = 1e-4;       ///< error of a node

/// Each number as the mean of itself and its neighbours.
ArrayXd pooled(const ArrayXd& values) {
    ArrayXd means(values.size());
    for (Index k = 0; k < values.size(); ++k) {
        const Index from = std::max<Index>(0, k - pooled_neighbours);
        const Index to = std::min<Index>(values.size() - 1, k + pooled_neighbours);
        means[k] = values.segment(from, to - from + 1).mean();
    }
    return means;
}

/// Standard errors of means over structures whose variance is in proportion to what breaks on the way to a node.
/// @param parts nodes x structures.
ArrayXd standard_errors(const Eigen::MatrixXd& parts, const ArrayXd& breaks) {
    const auto structures = static_cast<double>(parts.cols());
    const ArrayXd scatter = pooled(parts.cwiseAbs2().rowwise().sum().array() / (structures - 1));
    return (scatter * (breaks > 0).select(breaks / pooled(breaks), 0) / structures).sqrt();
}

/// A smooth function through noisy values.
struct Smooth {
    ArrayXd mean;
    Eigen::MatrixXd errors;  ///< independent ones, a column each
};

Eigen::MatrixXd covariance(const ArrayXd& places, double amplitude) {
    const Index count = places.size();
    const Eigen::ArrayXXd distance = places.replicate(1, count) - places.transpose().replicate(count, 1);
    return amplitude * amplitude * (-0.5 * (distance / length).square()).exp();
}

Smooth smooth(const ArrayXd& places, const ArrayXd& values, const ArrayXd& noise, double level, double amplitude) {
    const Eigen::MatrixXd prior = covariance(places, amplitude);
    Eigen::MatrixXd all = prior;
    all.diagonal().array() += noise.square() + 1e-8;
    const Eigen::LLT<Eigen::MatrixXd> factor(all);
    const Eigen::VectorXd departure = (values - level).matrix();
    const Eigen::MatrixXd posterior = prior - prior * factor.solve(prior);
    const dense::SymmetricModes axes(0.5 * (posterior + posterior.transpose()));
    const ArrayXd deviations = axes.values.array().max(0).sqrt();
    return {level + (prior * factor.solve(departure)).array(), axes.vectors * deviations.matrix().asDiagonal()};
}

/// Their common level if they scatter about it by the noise and the smooth function.
double level_of(const ArrayXd& places, const ArrayXd& values, const ArrayXd& noise, double amplitude) {
    Eigen::MatrixXd all = covariance(places, amplitude);
    all.diagonal().array() += noise.square();
    const Eigen::VectorXd weights = all.ldlt().solve(Eigen::VectorXd::Ones(values.size()));
    return weights.dot(values.matrix()) / weights.sum();
}

/// The mean of the structures' curves and how they differ from it.
class StructureSample {
public:
    StructureSample(const std::vector<double>& loads, const Eigen::MatrixXcd& structures);
    Eigen::MatrixXcd curve_and_errors() const;

private:
    Smooth rates() const;
    Smooth ratios() const;
    Eigen::VectorXcd curve(const ArrayXd& rates, const ArrayXd& ratios) const;

    Eigen::VectorXcd mean_;
    ArrayXd widths_;              ///< of the steps in the logarithm of the load
    ArrayXd places_;              ///< middles of the steps
    ArrayXd mean_square_;         ///< of the load within a step over its last square, over 2 pi: energy stored per modulus
    ArrayXd before_;              ///< modulus before a step
    ArrayXd breaks_;              ///< what is lost of it
    Eigen::MatrixXd broken_;      ///< nodes x structures: what each breaks otherwise than in proportion to what it has left
    Eigen::MatrixXd other_loss_;  ///< what each loses otherwise than by that
};

StructureSample::StructureSample(const std::vector<double>& loads, const Eigen::MatrixXcd& structures)
    : mean_(structures.rowwise().mean()) {
    const Index nodes = mean_.size();
    const Eigen::Map<const ArrayXd> load(loads.data(), nodes);
    ArrayXd last(nodes);
    last << 0, load.head(nodes - 1);
    mean_square_ = (load.square() + load * last + last.square()) / (6 * std::numbers::pi * load.square());
    last[0] = 0.5 * load[0];
    widths_ = (load / last).log();
    places_ = 0.5 * (load.log() + last.log());
    before_.resize(nodes);
    before_ << 1, mean_.head(nodes - 1).array().real();
    before_ = before_.max(still_intact);
    const ArrayXd kept = mean_.array().real() / before_;
    const Eigen::MatrixXcd differences = structures.colwise() - mean_;
    broken_ = differences.real();
    broken_.bottomRows(nodes - 1) -= kept.tail(nodes - 1).matrix().asDiagonal() * differences.real().topRows(nodes - 1);
    const double squares = broken_.squaredNorm();
    const double cost = squares > 0 ? broken_.cwiseProduct(differences.imag()).sum() / squares : 0.0;
    other_loss_ = differences.imag() - cost * broken_;
    breaks_ = (before_ - mean_.array().real()).max(0);
}

/// Part of the modulus that is lost per logarithm of the load. Its noise goes with what is expected to break, not with what did.
Smooth StructureSample::rates() const {
    const ArrayXd rates = breaks_ / before_ / widths_;
    ArrayXd expected = breaks_;
    Smooth found;
    for (int round = 0; round < 3; ++round) {
        found = smooth(places_, rates, standard_errors(broken_, expected) / before_ / widths_, 0, rate_amplitude);
        expected = found.mean.max(least_rate) * widths_ * before_;
    }
    return found;
}

/// Energy lost over what the broken bonds had stored.
Smooth StructureSample::ratios() const {
    const ArrayXd stored = mean_square_ * breaks_;
    const auto breaking = stored > 1e-4;
    const ArrayXd divisor = breaking.select(stored, 1);
    const ArrayXd values = breaking.select(mean_.array().imag() / divisor, 1);
    const ArrayXd noise = breaking.select((standard_errors(other_loss_, breaks_) / divisor).max(least_noise), unknown);
    return smooth(places_, values, noise, level_of(places_, values, noise, ratio_amplitude), ratio_amplitude);
}

Eigen::VectorXcd StructureSample::curve(const ArrayXd& rates, const ArrayXd& ratios) const {
    Eigen::VectorXcd found(rates.size());
    double left = 1;
    for (Index node = 0; node < rates.size(); ++node) {
        const double lost = left * std::clamp(rates[node] * widths_[node], 0.0, 1.0);
        left -= lost;
        found[node] = Complex(left, std::max(0.0, ratios[node]) * mean_square_[node] * lost);
    }
    return found;
}

Eigen::MatrixXcd StructureSample::curve_and_errors() const {
    constexpr double step = 1e-3;
    const Smooth rate = rates();
    const Smooth ratio = ratios();
    const Eigen::VectorXcd middle = curve(rate.mean, ratio.mean);
    std::vector<Eigen::VectorXcd> all{middle};
    const auto add = [&](const ArrayXd& rates, const ArrayXd& ratios) {
        const Eigen::VectorXcd change = (curve(rates, ratios) - middle) / step;
        if (change.cwiseAbs().maxCoeff() > visible) {
            all.emplace_back(middle + change);
        }
    };
    for (const auto& error : rate.errors.colwise()) {
        add(rate.mean + step * error.array(), ratio.mean);
    }
    for (const auto& error : ratio.errors.colwise()) {
        add(rate.mean, ratio.mean + step * error.array());
    }
    Eigen::MatrixXcd columns(middle.size(), static_cast<Index>(all.size()));
    for (std::size_t k = 0; k < all.size(); ++k) {
        columns.col(static_cast<Index>(k)) = all[k];
    }
    return columns;
}

}  // namespace

Eigen::MatrixXcd population_curve(const std::vector<double>& loads, const Eigen::MatrixXcd& structures) {
    return structures.cols() < 2 ? structures : StructureSample(loads, structures).curve_and_errors();
}

}  // namespace coagula::diagnose
