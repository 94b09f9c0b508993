// The base model with a smooth correction: what stands for "none of the catalogue". It is a Gaussian process of each observable
// along one coordinate, the sum of two of these, or one along all coordinates together, in proportion to |G*|; a correlation length
// is a part of the range of a coordinate, which is taken as a rank.
#pragma once

#include "hypothesis.hpp"

#include <vector>

namespace coagula::diagnose {

/// Log evidence of the base model with that correction, averaged over coordinates, amplitudes and lengths; the same normalisation
/// as Fit::log_evidence.
/// @param base prediction of the base model fitted to the data.
double flexible_evidence(const DataSet& data, const Forward& forward, const Eigen::VectorXd& base);

/// Prediction of all observations by the best of these corrections, conditioned on the observations in `known`.
Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known);

}  // namespace coagula::diagnose
