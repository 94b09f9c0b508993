// Normal effects that many numbers share.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

using Eigen::Index;

/// Independent effects e ~ N(0, 1) on numbers r = X e + n, n ~ N(0, 1 / weight): one of each sample on its own numbers, and others
/// on any. Nothing in it cancels: the misfit is a sum of squares at the most probable e, however large the numbers.
class NormalEffects {
public:
    /// @param level of each number by the effect of its sample. @param sample of each number, -1: of none.
    NormalEffects(Eigen::VectorXd level, const std::vector<Index>& sample, Index samples, Eigen::MatrixXd others);

    void solve(const Eigen::VectorXd& numbers, const Eigen::VectorXd& weights);

    /// Of the samples, then the others.
    const Eigen::VectorXd& most_probable() const { return effects_; }
    Eigen::MatrixXd covariance() const;
    /// Sum of the weighted squares of what is left and of the squares of the effects.
    double misfit() const { return misfit_; }
    /// Of the covariance of the numbers over that of n.
    double log_determinant() const { return log_determinant_; }
    /// Of n, over what the numbers leave open about e.
    Eigen::VectorXd expected_squares() const;

private:
    Eigen::VectorXd level_;
    const std::vector<Index>& sample_;
    Eigen::MatrixXd others_;
    // Precision of e: diagonal for the samples, in full for the others, and between both.
    Eigen::VectorXd own_;
    Eigen::MatrixXd between_;
    Eigen::LLT<Eigen::MatrixXd> rest_;  ///< of the others once the samples are eliminated
    Eigen::VectorXd effects_;
    Eigen::VectorXd left_;
    double misfit_ = 0;
    double log_determinant_ = 0;
};

}  // namespace coagula::diagnose
