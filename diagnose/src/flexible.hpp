// The base model with a smooth correction, a Gaussian process along the coordinates: what stands for "none of the catalogue".
#pragma once

#include "hypothesis.hpp"

#include <vector>

namespace coagula::diagnose {

/// Covariance of a smooth multiplicative correction of size `amplitude` and correlation length `length` (part of the range of each
/// coordinate, which is taken as a rank) of each observable, in proportion to |G*| of the observations' values.
Eigen::MatrixXd smooth_covariance(const std::vector<Observation>& observations, double amplitude, double length);

/// Log evidence of the base model with that correction, averaged over amplitudes and lengths; the same normalisation as
/// Fit::log_evidence.
/// @param base prediction of the base model fitted to the data.
double flexible_evidence(const DataSet& data, const Forward& forward, const Eigen::VectorXd& base);

/// Prediction of all observations by the best of these corrections, conditioned on the observations in `known`.
Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known);

}  // namespace coagula::diagnose
