// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of a prediction that comes from a sample of its own, such as some structures.
#pragma once

#include <Eigen/Core>

#include <limits>

namespace coagula::diagnose {

/// Independent errors of a prediction, over their standard errors.
struct ModelErrors {
    Eigen::MatrixXd changes = {};                              ///< numbers x errors: slopes of the numbers by these
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which their common scale is known
    Eigen::VectorXd linearised_at = {};  ///< errors at which numbers and slopes are those of the model; empty: 0
};

}  // namespace coagula::diagnose
