// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised minimal residuals for one right-hand side.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace coagula::mechanics {

struct KrylovSolution {
    Eigen::VectorXd solution;
    int iterations = 0;
    double residual = 1;  ///< relative, estimated by the recursion
};

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Solves A x = b (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856), without restart: the residual b - A x is the least
/// that is possible in the space spanned by b, A b, A^2 b ...
KrylovSolution minimise_residual(const LinearMap& matrix, const Eigen::VectorXd& b, double tolerance, int most_iterations);

}  // namespace coagula::mechanics
