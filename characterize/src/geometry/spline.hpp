// SPDX-License-Identifier: GPL-3.0-or-later
// Cubic spline interpolation. Internal.
#pragma once

#include <Eigen/Core>

namespace coagula::characterize {

/// The cubic spline through columns of values (n x K) at ascending nodes (n >= 4), at the points x (m) within the nodes; the third
/// derivative is continuous at the first and the last inner node ("not a knot"). @returns m x K.
Eigen::MatrixXd spline_interpolate(const Eigen::VectorXd& nodes, const Eigen::MatrixXd& values, const Eigen::VectorXd& x);

}  // namespace coagula::characterize
