#include "likelihood.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace coagula::diagnose {

Eigen::MatrixXd covariance_of(const std::vector<Observation>& observations, const Scatter& storage, const Scatter& loss) {
    const auto count = static_cast<Index>(observations.size());
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
    for (Index i = 0; i < count; ++i) {
        const Observation& one = observations[static_cast<std::size_t>(i)];
        const Scatter& scatter = one.loss ? loss : storage;
        const double row =
            std::isfinite(one.standard_error) ? one.standard_error : std::hypot(scatter.floor, scatter.relative * one.value);
        covariance(i, i) = row * row;
    }
    return covariance;
}

Likelihood::Likelihood(const Eigen::VectorXd& data, const Eigen::MatrixXd& covariance, std::vector<std::string> samples,
                       double effect)
    : factor_(covariance), effect_(effect) {
    if (factor_.info() != Eigen::Success) {
        throw std::runtime_error("the covariance of the data is singular: the stated noise of some rows is zero");
    }
    for (const std::string& sample : samples) {
        const auto found = std::find(names_.begin(), names_.end(), sample);
        group_.push_back(found - names_.begin());
        if (found == names_.end()) {
            names_.push_back(sample);
        }
    }
    groups_ = static_cast<Index>(names_.size());
    data_ = factor_.matrixL().solve(data);
    log_determinant_ = 2 * factor_.matrixLLT().diagonal().array().log().sum();
}

Eigen::VectorXd Likelihood::whiten(const Eigen::VectorXd& values) const {
    return factor_.matrixL().solve(values);
}

Eigen::MatrixXd Likelihood::effect_directions(const Eigen::VectorXd& prediction) const {
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(prediction.size(), groups_);
    for (Index row = 0; row < prediction.size(); ++row) {
        parts(row, group_[static_cast<std::size_t>(row)]) = prediction[row];
    }
    return factor_.matrixL().solve(parts);
}

Eigen::VectorXd Likelihood::residual(const Eigen::VectorXd& prediction) const {
    return data_ - whiten(prediction) - effect_directions(prediction) * effects(prediction);
}

Eigen::VectorXd Likelihood::effects(const Eigen::VectorXd& prediction) const {
    if (effect_ <= 0) {
        return Eigen::VectorXd::Zero(groups_);
    }
    const Eigen::MatrixXd directions = effect_directions(prediction);
    Eigen::MatrixXd normal = directions.transpose() * directions;
    normal.diagonal().array() += 1 / (effect_ * effect_);
    return normal.ldlt().solve(directions.transpose() * (data_ - whiten(prediction)));
}

double Likelihood::log_density(const Eigen::VectorXd& prediction) const {
    const Eigen::VectorXd plain = data_ - whiten(prediction);
    if (effect_ <= 0) {
        return -0.5 * (plain.squaredNorm() + log_determinant_);
    }
    // Woodbury's identity for the covariance + effect^2 m m^T of each sample.
    const Eigen::MatrixXd directions = effect_ * effect_directions(prediction);
    Eigen::MatrixXd normal = directions.transpose() * directions;
    normal.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(normal);
    const Eigen::VectorXd projected = directions.transpose() * plain;
    const double explained = projected.dot(factor.solve(projected));
    const double determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
    return -0.5 * (plain.squaredNorm() - explained + log_determinant_ + determinant);
}

}  // namespace coagula::diagnose
