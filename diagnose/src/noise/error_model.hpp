// SPDX-License-Identifier: GPL-3.0-or-later
// The errors of measured numbers and of their predictions: the one place where noise lives. Test, evidence, gain and power ask it.
//
//     y = m(b) + M e + s n,   whitened
//
// with the effect b of each sample on the level of the material, the errors e of the prediction itself, and the errors n of the
// rows, whose deviations are known up to a factor s where they were estimated. All three are integrated out: b and e are normal;
// the factors by Laplace's approximation, the deviations of b and e, where few samples or structures tell them, over seven equally
// probable values.
#pragma once

#include "data_set.hpp"
#include "low_rank.hpp"
#include "prediction.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace coagula::diagnose {

/// Whether deviations that were estimated are integrated out as a whole, or taken at the middle of what they may be: then the
/// density has its maximum nearly at the same prediction.
enum class Accuracy { whole, middle };

/// Departures whose deviations share a factor that is known from so many degrees of freedom only.
struct ScaledRows {
    double degrees;
    std::vector<Index> rows;
};

class ErrorModel {
public:
    /// @param data must outlive this.
    explicit ErrorModel(const DataSet& data);

    Index size() const { return white_.size(); }
    const DataSet& data() const { return data_; }
    /// The rows of each estimate of noise.
    std::vector<ScaledRows> rows_of_scales() const;

    /// Values over the deviation of their rows and freed from the correlation of neighbours.
    Eigen::VectorXd whiten(const Eigen::VectorXd& values) const { return data_.noise.whiten(values); }

    /// Whitened data less prediction at the most probable effects and errors of the prediction: independent standard normal numbers
    /// if the model is true.
    Eigen::VectorXd residual(const Prediction& prediction) const;
    /// Most probable effects b, one per sample, then the errors of the prediction over their standard error.
    /// @param further as in log_density.
    Eigen::VectorXd effects(const Prediction& prediction, const Eigen::MatrixXd& further = {}) const;
    /// Covariance of these.
    Eigen::MatrixXd effect_covariance(const Prediction& prediction) const;
    /// Whitened directions in which these move the prediction: one column per sample, then those of the prediction's errors.
    Eigen::MatrixXd directions(const Prediction& prediction) const;

    /// Logarithm of the density of the data, but for n/2 log(2 pi).
    /// @param further whitened directions, of unit deviation each, in which the data may depart besides.
    double log_density(const Prediction& prediction, const Eigen::MatrixXd& further = {},
                       Accuracy accuracy = Accuracy::whole) const;
    /// The same at the prediction less a change, at it, and with the change; the errors of the prediction stay.
    std::array<double, 3> log_densities(const Prediction& prediction, const Prediction& change, Accuracy accuracy) const;
    /// The same where the last of these directions, so many, are of each of these deviations.
    std::vector<double> log_densities(const Prediction& prediction, const Eigen::MatrixXd& further, Index last,
                                      std::span<const double> deviations) const;
    /// What that of no prediction exceeds: that of one that meets every number.
    double saturated() const { return saturated_; }

    /// Whitened errors of the rows, then the effects of the samples over their deviation, as this model draws them: heavy tails and
    /// the uncertainty of estimated deviations and correlations included.
    Eigen::VectorXd draw(std::uint64_t seed, std::uint64_t number) const;
    /// Covariance of data about a prediction without errors of its own, where deviations are as stated.
    Eigen::MatrixXd covariance(const Prediction& prediction) const;
    /// Data that may be measured where this prediction is exact, with such errors and effects.
    Eigen::VectorXd drawn_about(const Prediction& prediction, std::uint64_t seed, std::uint64_t number) const;

private:
    class Scales;
    struct Shared;
    Eigen::VectorXd whitened_level(const Prediction& prediction) const;
    template <class At>
    void for_deviations(Shared& shared, double degrees, Accuracy accuracy, const At& at) const;
    double mean_density(const std::vector<double>& logarithms) const;
    static double log_at(const NormalEffects& effects, const Scales& scales);
    double log_density(Shared& shared, NormalEffects& effects, double degrees, Accuracy accuracy) const;
    double log_marginal(NormalEffects& effects, double effect, const Eigen::VectorXd& scales_of_others, Scales& scales) const;

    const DataSet& data_;
    Eigen::VectorXd white_;  ///< the data
    double log_determinant_;
    double saturated_;
    std::vector<double> variances_;               ///< equally probable ones of the sample effect
    std::vector<double> degrees_;                 ///< of freedom of each scale
    std::shared_ptr<const Belonging> belonging_;  ///< of the rows to scales, from 1; to 0 where the deviation is known
};

}  // namespace coagula::diagnose
