#include "low_rank.hpp"

#include <utility>

namespace coagula::diagnose {

NormalEffects::NormalEffects(Eigen::VectorXd level, const std::vector<Index>& sample, Index samples, Eigen::MatrixXd others)
    : level_(std::move(level)),
      sample_(sample),
      others_(std::move(others)),
      own_(samples),
      between_(samples, others_.cols()),
      effects_(samples + others_.cols()) {}

void NormalEffects::solve(const Eigen::VectorXd& numbers, const Eigen::VectorXd& weights) {
    const Index samples = own_.size();
    own_.setOnes();
    between_.setZero();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(effects_.size());
    for (Index row = 0; row < numbers.size(); ++row) {
        if (const Index sample = sample_[static_cast<std::size_t>(row)]; sample >= 0) {
            const double weighted = weights[row] * level_[row];
            own_[sample] += weighted * level_[row];
            right[sample] += weighted * numbers[row];
            between_.row(sample) += weighted * others_.row(row);
        }
    }
    log_determinant_ = own_.array().log().sum();
    if (others_.cols() > 0) {
        const Eigen::MatrixXd weighted = weights.asDiagonal() * others_;
        Eigen::MatrixXd precision = others_.transpose() * weighted;
        precision.diagonal().array() += 1;
        const Eigen::MatrixXd eliminated = own_.cwiseInverse().asDiagonal() * between_;
        rest_.compute(precision - between_.transpose() * eliminated);
        log_determinant_ += 2 * rest_.matrixLLT().diagonal().array().log().sum();
        right.tail(others_.cols()) = weighted.transpose() * numbers;
        effects_.tail(others_.cols()) = rest_.solve(right.tail(others_.cols()) - eliminated.transpose() * right.head(samples));
    }
    effects_.head(samples) = (right.head(samples) - between_ * effects_.tail(others_.cols())).cwiseQuotient(own_);
    left_ = numbers - others_ * effects_.tail(others_.cols());
    for (Index row = 0; row < numbers.size(); ++row) {
        if (const Index sample = sample_[static_cast<std::size_t>(row)]; sample >= 0) {
            left_[row] -= level_[row] * effects_[sample];
        }
    }
    misfit_ = left_.cwiseAbs2().dot(weights) + effects_.squaredNorm();
}

Eigen::MatrixXd NormalEffects::covariance() const {
    const Index samples = own_.size();
    const Index others = others_.cols();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(samples + others, samples + others);
    all.topLeftCorner(samples, samples).diagonal() = own_.cwiseInverse();
    if (others > 0) {
        const Eigen::MatrixXd eliminated = own_.cwiseInverse().asDiagonal() * between_;
        const Eigen::MatrixXd rest = rest_.solve(Eigen::MatrixXd::Identity(others, others));
        all.topLeftCorner(samples, samples) += eliminated * rest * eliminated.transpose();
        all.topRightCorner(samples, others) = -eliminated * rest;
        all.bottomLeftCorner(others, samples) = all.topRightCorner(samples, others).transpose();
        all.bottomRightCorner(others, others) = rest;
    }
    return all;
}

Eigen::VectorXd NormalEffects::expected_squares() const {
    Eigen::VectorXd squares = left_.cwiseAbs2();
    Eigen::MatrixXd beyond = others_;  // what the other effects move once those of the samples follow
    for (Index row = 0; row < squares.size(); ++row) {
        if (const Index sample = sample_[static_cast<std::size_t>(row)]; sample >= 0) {
            squares[row] += level_[row] * level_[row] / own_[sample];
            beyond.row(row) -= level_[row] / own_[sample] * between_.row(sample);
        }
    }
    if (others_.cols() > 0) {
        squares += rest_.matrixL().solve(beyond.transpose()).colwise().squaredNorm().transpose();
    }
    return squares;
}

}  // namespace coagula::diagnose
