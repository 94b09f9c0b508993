// SPDX-License-Identifier: GPL-3.0-or-later
// All by which data depart from a fitted model, and how the fitted quantities move it.
#pragma once

#include "hypothesis.hpp"
#include "noise/row_correlation.hpp"

#include <Eigen/Core>

namespace coagula::diagnose {

/// Whitened residuals: of the observations, then of each sample its effect over the deviation of the effects (if these have one),
/// then the errors of the model over their standard error, then that of the stiffness from the known one over its error (if it is
/// known). Independent with unit variance if the model is true.
struct Departures {
    Eigen::VectorXd residual;
    Eigen::MatrixXd jacobian;  ///< of the prediction: stiffness, parameters, sample effects, errors of the model
};
Departures departures_of(const Inference& inference, const Fit& fit);

/// Correlation of rows, from the deviations from the fitted base model without its most probable effects and errors.
RowCorrelations correlations_by_base(const Forward& forward, const DataSet& data);

/// Orthonormal columns that span those given.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

}  // namespace coagula::diagnose
