// SPDX-License-Identifier: GPL-3.0-or-later
// Where a mechanism would move the numbers from a fit.
#pragma once

#include "hypothesis.hpp"

#include <vector>

namespace coagula::diagnose {

/// Steps from a fit towards a mechanism that it does not have, over the whole prior, as unit vectors of whitened numbers orthogonal
/// to what the fitted quantities move. @param about prediction of the fit. @param basis orthonormal, of what these move.
std::vector<Eigen::VectorXd> steps_towards(const Mechanism& mechanism, const Inference& inference, const Fit& fit,
                                           const Prediction& about, const Eigen::MatrixXd& basis);

/// The part of such steps, in columns, that some rows make, as unit vectors orthogonal to the same; those of which these rows make
/// next to nothing are left out.
Eigen::MatrixXd steps_in(const std::vector<Index>& rows, const Eigen::MatrixXd& steps, const Eigen::MatrixXd& basis);

}  // namespace coagula::diagnose
