// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/straight_line.hpp>

#include <cmath>

namespace coagula::mechanics {

namespace {

void check_points(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index fewest) {
    require(x.size() == y.size() && x.allFinite() && y.allFinite(), "a straight line needs pairs of finite numbers");
    require(x.size() >= fewest,
            "this straight line needs at least " + std::to_string(fewest) + " points, but there are " + std::to_string(x.size()));
}

/// Sum of squared residuals over the degrees of freedom; unset without any.
double residual_variance(const Eigen::VectorXd& residuals, Eigen::Index parameters) {
    const Eigen::Index freedom = residuals.size() - parameters;
    return freedom > 0 ? residuals.squaredNorm() / static_cast<double>(freedom) : unset;
}

}  // namespace

StraightLine fit_line(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    check_points(x, y, 2);
    const Eigen::VectorXd from_mean = x.array() - x.mean();
    const double spread = from_mean.squaredNorm();
    require(x.maxCoeff() > x.minCoeff() && spread > 0, "a straight line needs at least two different x");
    StraightLine line;
    line.slope = from_mean.dot(y) / spread;
    line.intercept = y.mean() - line.slope * x.mean();
    const Eigen::VectorXd residuals = y.array() - line.intercept - line.slope * x.array();
    const double variance = residual_variance(residuals, 2);
    const auto count = static_cast<double>(x.size());
    line.slope_stderr = std::sqrt(variance / spread);
    line.intercept_stderr = std::sqrt(variance * (1 / count + x.mean() * x.mean() / spread));
    line.rms_residual = std::sqrt(residuals.squaredNorm() / count);
    return line;
}

StraightLine fit_line_through_origin(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    check_points(x, y, 1);
    const double squares = x.squaredNorm();
    require(squares > 0, "a straight line through the origin needs an x that is not 0");
    StraightLine line;
    line.slope = x.dot(y) / squares;
    const Eigen::VectorXd residuals = y - line.slope * x;
    line.slope_stderr = std::sqrt(residual_variance(residuals, 1) / squares);
    line.rms_residual = std::sqrt(residuals.squaredNorm() / static_cast<double>(x.size()));
    return line;
}

}  // namespace coagula::mechanics
