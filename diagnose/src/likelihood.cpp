#include "likelihood.hpp"

#include "weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::diagnose {

namespace {

/// Equally probable variances about an estimate from some degrees of freedom: scaled inverse chi-square.
std::vector<double> variances_about(double estimate, double degrees) {
    if (!std::isfinite(degrees) || estimate == 0) {
        return {estimate};
    }
    // Middles of seven equal parts of the normal distribution.
    std::vector<double> variances;
    for (const double normal : {-1.4652, -0.7916, -0.3661, 0.0, 0.3661, 0.7916, 1.4652}) {
        variances.push_back(estimate / scaled_chi_square(degrees, normal));
    }
    return variances;
}

/// Places of seven variances beside those of another quantity, so that both are spread evenly and independently.
constexpr std::array<std::size_t, 7> beside{3, 6, 1, 4, 0, 5, 2};

}  // namespace

Likelihood::Likelihood(const DataSet& data)
    : data_(data),
      white_(data.noise.whiten(data.values)),
      log_determinant_(data.noise.log_determinant()),
      variances_(variances_about(data.effect * data.effect, data.effect_degrees)) {}

Likelihood::Likelihood(const DataSet& data, const Eigen::MatrixXd& further)
    : data_(data),
      factor_(data.noise.covariance() + further),
      dense_(true),
      variances_(variances_about(data.effect * data.effect, data.effect_degrees)) {
    white_ = factor_.matrixL().solve(data.values);
    log_determinant_ = 2 * factor_.matrixLLT().diagonal().array().log().sum();
}

Eigen::VectorXd Likelihood::whiten(const Eigen::VectorXd& values) const {
    return dense_ ? Eigen::VectorXd(factor_.matrixL().solve(values)) : data_.noise.whiten(values);
}

Eigen::MatrixXd Likelihood::effect_directions(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(prediction.size(), data_.samples() + model.changes.cols());
    // Rows of different samples have independent errors: whitening then keeps each in its column.
    const Eigen::VectorXd values = dense_ ? prediction : whiten(prediction);
    for (Index row = 0; row < prediction.size(); ++row) {
        if (const Index sample = data_.sample[static_cast<std::size_t>(row)]; sample >= 0) {
            parts(row, sample) = values[row];
        }
    }
    for (Index error = 0; error < model.changes.cols(); ++error) {
        parts.col(data_.samples() + error) = dense_ ? Eigen::VectorXd(model.changes.col(error)) : whiten(model.changes.col(error));
    }
    return dense_ ? Eigen::MatrixXd(factor_.matrixL().solve(parts)) : parts;
}

Eigen::VectorXd Likelihood::residual(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    return white_ - whiten(prediction) - effect_directions(prediction, model) * effects(prediction, model);
}

/// Standard deviations of sample effects and of the model's errors.
Eigen::VectorXd Likelihood::deviations(double effect, double error, Index directions) const {
    Eigen::VectorXd all = Eigen::VectorXd::Constant(directions, error);
    all.head(data_.samples()).setConstant(effect);
    return all;
}

/// Effects over their standard deviations before there are data.
struct Likelihood::Effects {
    Eigen::VectorXd deviation;
    Eigen::MatrixXd directions;
    Eigen::LDLT<Eigen::MatrixXd> precision;
};

Likelihood::Effects Likelihood::effects_given(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    const Eigen::MatrixXd plain = effect_directions(prediction, model);
    const Eigen::VectorXd deviation = deviations(std::max(data_.effect, 0.0), 1, plain.cols());
    const Eigen::MatrixXd directions = plain * deviation.asDiagonal();
    Eigen::MatrixXd precision = directions.transpose() * directions;
    precision.diagonal().array() += 1;
    return {deviation, directions, precision.ldlt()};
}

Eigen::VectorXd Likelihood::effects(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    const Effects given = effects_given(prediction, model);
    return given.deviation.cwiseProduct(given.precision.solve(given.directions.transpose() * (white_ - whiten(prediction))));
}

Eigen::MatrixXd Likelihood::effect_covariance(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    const Effects given = effects_given(prediction, model);
    return given.deviation.asDiagonal() * given.precision.solve(Eigen::MatrixXd(given.deviation.asDiagonal()));
}

double Likelihood::log_density(const Eigen::VectorXd& prediction, const ModelErrors& model) const {
    const Eigen::VectorXd white = whiten(prediction);
    if (dense_ || model.changes.cols() > 0) {
        return dense_log_density(white_ - white, effect_directions(prediction, model), model.degrees);
    }
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(data_.samples());
    Eigen::ArrayXd products = Eigen::ArrayXd::Zero(data_.samples());
    double misfit = 0;
    for (Index row = 0; row < white.size(); ++row) {
        const Index sample = data_.sample[static_cast<std::size_t>(row)];
        const double plain = white_[row] - white[row];
        misfit += plain * plain;
        if (sample < 0) {
            continue;
        }
        squares[sample] += white[row] * white[row];
        products[sample] += white[row] * plain;
    }
    // Woodbury's identity for the covariance + variance m m^T of each sample: the samples are independent, a number for each.
    std::vector<double> logarithms;
    for (const double variance : variances_) {
        const Eigen::ArrayXd normal = 1 + variance * squares;
        logarithms.push_back(-0.5 * (normal.log().sum() - variance * (products.square() / normal).sum()));
    }
    return log_sum(logarithms) - std::log(static_cast<double>(variances_.size())) - 0.5 * (misfit + log_determinant_);
}

/// The same where errors of different samples are correlated. @param degrees of freedom of the model's errors.
double Likelihood::dense_log_density(const Eigen::VectorXd& plain, const Eigen::MatrixXd& directions, double degrees) const {
    const Eigen::MatrixXd squares = directions.transpose() * directions;
    const Eigen::VectorXd products = directions.transpose() * plain;
    std::vector<double> logarithms;
    const std::vector<double> errors = variances_about(1, degrees);
    for (std::size_t k = 0; k < std::max(variances_.size(), errors.size()); ++k) {
        const double effect = std::sqrt(variances_[variances_.size() > 1 ? k : 0]);
        const double error = std::sqrt(errors[errors.size() > 1 ? beside.at(k) : 0]);
        const Eigen::VectorXd deviation = deviations(effect, error, directions.cols());
        const Eigen::MatrixXd scaled = deviation.asDiagonal() * squares * deviation.asDiagonal();
        const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols()) + scaled);
        const double determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
        const Eigen::VectorXd projection = deviation.cwiseProduct(products);
        logarithms.push_back(-0.5 * (determinant - projection.dot(factor.solve(projection))));
    }
    return log_sum(logarithms) - std::log(static_cast<double>(logarithms.size())) - 0.5 * (plain.squaredNorm() + log_determinant_);
}

}  // namespace coagula::diagnose
