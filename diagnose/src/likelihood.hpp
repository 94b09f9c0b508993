// Gaussian likelihood of the observations: y = m (1 + b) + e with the prediction m, an effect b of each sample and an error e of
// each row.
#pragma once

#include "forward.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <string>
#include <vector>

namespace coagula::diagnose {

/// Standard deviation of one observable in a row: sqrt(floor^2 + (relative level)^2).
struct Scatter {
    double floor = 0;  ///< [Pa]
    double relative = 0.05;
};

/// Covariance of the rows' errors at the measured levels.
Eigen::MatrixXd covariance_of(const std::vector<Observation>& observations, const Scatter& storage, const Scatter& loss);

/// Data with their errors; sample effects are integrated out (log_density) or taken at their most probable values (residual).
class Likelihood {
public:
    /// @param covariance of the errors e. @param samples of each observation. @param effect standard deviation of b.
    Likelihood(const Eigen::VectorXd& data, const Eigen::MatrixXd& covariance, std::vector<std::string> samples, double effect);

    Index size() const { return data_.size(); }
    /// Whitened data less prediction: independent standard normal numbers if the model is true, but for the sample effects.
    Eigen::VectorXd residual(const Eigen::VectorXd& prediction) const;
    /// Most probable effects b, one per sample in the order of `effect_names`.
    Eigen::VectorXd effects(const Eigen::VectorXd& prediction) const;
    const std::vector<std::string>& effect_names() const { return names_; }
    /// Logarithm of the density of the data, but for n/2 log(2 pi).
    double log_density(const Eigen::VectorXd& prediction) const;
    /// Whitened directions in which the sample effects move the prediction, one column per sample.
    Eigen::MatrixXd effect_directions(const Eigen::VectorXd& prediction) const;
    Eigen::VectorXd whiten(const Eigen::VectorXd& values) const;

private:
    Eigen::LLT<Eigen::MatrixXd> factor_;
    Eigen::VectorXd data_;  ///< whitened
    std::vector<Index> group_;
    std::vector<std::string> names_;  ///< of the groups
    Index groups_ = 0;
    double effect_;
    double log_determinant_;
};

}  // namespace coagula::diagnose
