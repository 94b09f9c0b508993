// SPDX-License-Identifier: GPL-3.0-or-later
// Normal effects that many numbers share.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <memory>
#include <vector>

namespace coagula::diagnose {

using Eigen::Index;

/// Samples and groups of the numbers, made once for all effects on them.
struct Belonging {
    /// @param in_sample sample of each number, -1: of none. @param in_group group of each number, below `groups`.
    Belonging(std::vector<Index> in_sample, Index sample_count, const std::vector<std::size_t>& in_group, std::size_t groups);

    std::vector<Index> sample;
    Index samples;
    std::vector<std::vector<Index>> rows;  ///< of each group
};

/// Independent effects e ~ N(0, 1) on numbers r = X e + n, n ~ N(0, variance of the group of each number): one effect of each
/// sample on its own numbers, and others on any. Nothing in it cancels: the misfit is a sum of squares at the most probable e,
/// however large the numbers are. Products of the directions are made once, for all deviations and variances.
class NormalEffects {
public:
    /// @param level derivative of each number with respect to the effect of its sample.
    NormalEffects(std::shared_ptr<const Belonging> belonging, const Eigen::VectorXd& numbers, const Eigen::VectorXd& level,
                  const Eigen::MatrixXd& others);
    /// Without effects of samples; all numbers form one group.
    NormalEffects(const Eigen::VectorXd& numbers, const Eigen::MatrixXd& others);

    /// Replaces numbers and level. The directions of the other effects stay the same. @param level as in the constructor.
    void replace(const Eigen::VectorXd& numbers, const Eigen::VectorXd& level);

    /// @param effect standard deviation of the effects of the samples. @param scales standard deviations of the other effects.
    /// @param variances variances of the groups.
    void solve(double effect, const Eigen::VectorXd& scales, const std::vector<double>& variances);

    /// Most probable effects over their standard deviations: those of the samples first, then the others.
    const Eigen::VectorXd& most_probable() const { return effects_; }
    Eigen::MatrixXd covariance() const;
    /// Sum of the squared residuals over their variances and of the squared effects.
    double misfit() const { return misfit_; }
    /// Logarithm of the determinant of the covariance of the numbers over that of n.
    double log_determinant() const { return log_determinant_; }
    /// Sum of the squares of n in each group, over what the numbers leave open about e.
    std::vector<double> expected_squares() const;

private:
    /// Products of the directions of a group with each other and with its numbers.
    struct Products {
        Eigen::VectorXd own;      ///< of each sample's direction with itself
        Eigen::MatrixXd between;  ///< samples x others
        Eigen::MatrixXd rest;     ///< others x others
        Eigen::VectorXd right;    ///< of all with the numbers
    };

    void square_what_is_left(const std::vector<double>& variances);

    std::shared_ptr<const Belonging> belonging_;
    Eigen::VectorXd numbers_;
    Eigen::VectorXd level_;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> others_;
    std::vector<Products> products_;
    Eigen::VectorXd deviation_;  ///< of all effects
    // Precision of e: diagonal for the samples, in full for the others once the samples are eliminated, and between both.
    Eigen::VectorXd own_;
    Eigen::MatrixXd between_;
    Eigen::LLT<Eigen::MatrixXd> rest_;
    Eigen::VectorXd effects_;
    std::vector<double> squares_;  ///< left in each group
    double misfit_ = 0;
    double log_determinant_ = 0;
    // Kept from one solution to the next, for their memory.
    Eigen::MatrixXd precision_;
    Eigen::MatrixXd eliminated_;
    Eigen::VectorXd right_;
    Eigen::VectorXd left_;
};

}  // namespace coagula::diagnose
