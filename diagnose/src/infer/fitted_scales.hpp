// SPDX-License-Identifier: GPL-3.0-or-later
// Departures in units of deviations that they tell themselves.
#pragma once

#include "noise/error_model.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Returns the departures that share a scale: the rows of each estimate of noise, and the effects of the samples, in the order of
/// Departures.
/// A stated error is known and belongs to none. The errors of the prediction belong to none either: how much a material may vary is
/// a matter of the model, and real ones yield or relax faster than one by whose measure all others are judged.
std::vector<ScaledRows> scaled_rows(const ErrorModel& errors);

/// Fits each column again, with the most probable factors on the deviations of its groups, and returns its departures over these.
/// A scale that is known from few degrees of freedom makes a departure neither large nor small then: what counts is how far it
/// stands out of the rest of its group. (Student's t is to a normal number of estimated deviation what these are to the columns.)
/// @param columns departures over their stated deviations, orthogonal to the basis. @param basis orthonormal, of what the fitted
/// quantities move.
Eigen::MatrixXd over_fitted_scales(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& basis,
                                   const std::vector<ScaledRows>& groups);

}  // namespace coagula::diagnose
