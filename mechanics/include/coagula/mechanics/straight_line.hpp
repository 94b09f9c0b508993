// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines by least squares, through the origin or not.
#pragma once

#include <coagula/common/checks.hpp>

#include <Eigen/Core>

namespace coagula::mechanics {

/// y = intercept + slope x.
struct StraightLine {
    double slope = unset;
    double intercept = 0;
    double slope_stderr = unset;  ///< from the residuals; unset when the line goes through as many points as it has parameters
    double intercept_stderr = unset;
    double rms_residual = unset;
};

/// Throws std::invalid_argument for fewer than two points, values that are not finite or equal x.
StraightLine fit_line(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Fits a line through the origin: its intercept is 0 and has no error. Throws std::invalid_argument for no point, values that are
/// not finite or x that are all 0.
StraightLine fit_line_through_origin(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

}  // namespace coagula::mechanics
