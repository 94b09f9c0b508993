// SPDX-License-Identifier: GPL-3.0-or-later
#include "restricted_likelihood.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace coagula::diagnose {

namespace {

/// The covariance of one sample is D + t^2 m m^T (D diagonal, m the levels), inverted by Sherman and Morrison; the normal matrix of
/// the levels is then diagonal minus one rank per sample.
struct Sums {
    Sums(const ReplicatedValues& data, const Eigen::VectorXd& levels, const Eigen::VectorXd& effects, const Deviations& deviations)
        : weights(Eigen::VectorXd::Zero(data.conditions)),
          weighted(Eigen::VectorXd::Zero(data.conditions)),
          coupling(Eigen::MatrixXd::Zero(data.conditions, data.samples)),
          information(Eigen::VectorXd::Zero(data.samples)),
          projection(Eigen::VectorXd::Zero(data.samples)) {
        for (Eigen::Index i = 0; i < data.values.size(); ++i) {
            const Eigen::Index c = data.condition[static_cast<std::size_t>(i)];
            const Eigen::Index s = data.sample[static_cast<std::size_t>(i)];
            const double level = levels[c];
            const double floor = deviations[0] * data.floor_weights[c];
            const double relative = deviations[1] * level * (1 + effects[s]);
            const double variance = floor * floor + relative * relative;
            const double residual = data.values[i] - level;
            log_determinant += std::log(variance);
            square += residual * residual / variance;
            weights[c] += 1 / variance;
            weighted[c] += residual / variance;
            coupling(c, s) += level / variance;
            information[s] += level * level / variance;
            projection[s] += level * residual / variance;
        }
    }

    double log_determinant = 0;   ///< of D
    double square = 0;            ///< r^T D^-1 r, with r = values - levels
    Eigen::VectorXd weights;      ///< diagonal of X^T D^-1 X
    Eigen::VectorXd weighted;     ///< X^T D^-1 r
    Eigen::MatrixXd coupling;     ///< X^T D^-1 m, a column per sample
    Eigen::VectorXd information;  ///< m^T D^-1 m per sample
    Eigen::VectorXd projection;   ///< m^T D^-1 r per sample
};

}  // namespace

RestrictedFit restricted_fit(const ReplicatedValues& data, const Eigen::VectorXd& levels, const Eigen::VectorXd& effects,
                             const Deviations& deviations) {
    const Sums sums(data, levels, effects, deviations);
    const double variance = deviations[2] * deviations[2];
    const Eigen::ArrayXd shrink = 1 + variance * sums.information.array();
    const Eigen::VectorXd kappa = (variance / shrink).matrix();
    const Eigen::VectorXd root = kappa.cwiseSqrt();

    const Eigen::MatrixXd low_rank = sums.coupling * root.asDiagonal();
    const Eigen::MatrixXd scaled = sums.weights.cwiseInverse().asDiagonal() * low_rank;
    const Eigen::LLT<Eigen::MatrixXd> reduced(Eigen::MatrixXd::Identity(data.samples, data.samples) -
                                              low_rank.transpose() * scaled);
    RestrictedFit fit;
    if (reduced.info() != Eigen::Success) {
        fit.minus_log_likelihood = std::numeric_limits<double>::infinity();
        return fit;
    }
    const Eigen::VectorXd right = sums.weighted - sums.coupling * kappa.cwiseProduct(sums.projection);
    const Eigen::VectorXd shift = right.cwiseQuotient(sums.weights) + scaled * reduced.solve(scaled.transpose() * right);

    const double square = sums.square - sums.projection.cwiseAbs2().dot(kappa) - right.dot(shift);
    const double log_normal = sums.weights.array().log().sum() + 2 * reduced.matrixLLT().diagonal().array().log().sum();
    fit.minus_log_likelihood = 0.5 * (sums.log_determinant + shrink.log().sum() + log_normal + square);
    fit.levels = levels + shift;
    fit.effects = kappa.cwiseProduct(sums.projection - sums.coupling.transpose() * shift);
    return fit;
}

}  // namespace coagula::diagnose
