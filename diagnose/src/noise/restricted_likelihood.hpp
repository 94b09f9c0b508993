// SPDX-License-Identifier: GPL-3.0-or-later
// Restricted likelihood of replicated values with a floor, a relative part and a random effect per sample.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace coagula::diagnose {

/// Values with the condition and the sample of each.
struct ReplicatedValues {
    Eigen::VectorXd values;
    std::vector<Eigen::Index> condition;
    std::vector<Eigen::Index> sample;
    Eigen::VectorXd floor_weights;  ///< one per condition
    Eigen::Index conditions = 0;
    Eigen::Index samples = 0;
};

/// Standard deviations: floor (values over floor weight), relative part, sample effect.
using Deviations = std::array<double, 3>;

/// Terms of the likelihood at given deviations.
struct RestrictedFit {
    double minus_log_likelihood = 0;  ///< up to a constant
    Eigen::VectorXd levels;           ///< generalised least squares, one per condition
    Eigen::VectorXd effects;          ///< best linear unbiased prediction, one per sample
};

/// @param levels, effects those that enter the variances, one per condition and one per sample.
RestrictedFit restricted_fit(const ReplicatedValues& data, const Eigen::VectorXd& levels, const Eigen::VectorXd& effects,
                             const Deviations& deviations);

}  // namespace coagula::diagnose
