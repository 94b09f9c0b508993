// Likelihood of a data set: normal errors, sample effects integrated out.
#pragma once

#include "data_set.hpp"
#include "model_errors.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Data with their errors; sample effects are integrated out (log_density) or taken at their most probable values (residual). Where
/// their standard deviation was estimated from few samples, it is integrated out, too. A prediction may have errors of its own,
/// which are treated in the same way.
class Likelihood {
public:
    /// @param data must outlive this.
    explicit Likelihood(const DataSet& data);
    /// @param further covariance added to that of the rows' errors.
    Likelihood(const DataSet& data, const Eigen::MatrixXd& further);

    Index size() const { return white_.size(); }
    const DataSet& data() const { return data_; }
    /// Whitened data less prediction: independent standard normal numbers if the model is true, but for the sample effects.
    Eigen::VectorXd residual(const Eigen::VectorXd& prediction, const ModelErrors& model = {}) const;
    /// Most probable effects b, one per sample, then the errors of the model over their standard error.
    Eigen::VectorXd effects(const Eigen::VectorXd& prediction, const ModelErrors& model = {}) const;
    /// Covariance of these.
    Eigen::MatrixXd effect_covariance(const Eigen::VectorXd& prediction, const ModelErrors& model = {}) const;
    /// Logarithm of the density of the data, but for n/2 log(2 pi).
    double log_density(const Eigen::VectorXd& prediction, const ModelErrors& model = {}) const;
    /// Whitened directions in which the sample effects move the prediction, one column per sample, then those of the model's
    /// errors.
    Eigen::MatrixXd effect_directions(const Eigen::VectorXd& prediction, const ModelErrors& model = {}) const;
    Eigen::VectorXd whiten(const Eigen::VectorXd& values) const;

private:
    struct Effects;
    Effects effects_given(const Eigen::VectorXd& prediction, const ModelErrors& model) const;
    Eigen::VectorXd deviations(double effect, double error, Index directions) const;
    double dense_log_density(const Eigen::VectorXd& plain, const Eigen::MatrixXd& directions, double degrees) const;

    const DataSet& data_;
    Eigen::LLT<Eigen::MatrixXd> factor_;  ///< only with further covariance
    bool dense_ = false;
    Eigen::VectorXd white_;  ///< the data
    double log_determinant_;
    std::vector<double> variances_;  ///< equally probable ones of the sample effect
};

}  // namespace coagula::diagnose
