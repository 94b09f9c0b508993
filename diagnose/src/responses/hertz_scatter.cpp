// SPDX-License-Identifier: GPL-3.0-or-later
#include "hertz_scatter.hpp"

#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

using Eigen::MatrixXd;

// tests/benchmark/hertz_scatter.py measures what the next constants state.
constexpr double particles_of_curves = 400;  ///< in a structure of which the next hold
/// Principal errors of the logarithm at the nodes, the largest first.
const Eigen::Matrix<double, 3, hertz_axis.count> principal_errors{
    {0, 0, -0.0006, -0.0018, -0.0001, 0.0049, 0.0115, 0.0169, 0.0204, 0.0223, 0.0231, 0.0238},
    {0, 0, 0.0004, 0.0008, -0.0022, -0.0051, -0.0054, -0.0039, -0.0020, -0.0003, 0.0011, 0.0022},
    {0, 0, 0.0004, 0, -0.0020, -0.0023, -0.0007, 0.0011, 0.0027, 0.0017, 0.0003, -0.0008}};
/// Degrees of freedom from which the scale of these errors is known.
constexpr double degrees_of_curves = 6;
/// Error of the curve itself, over the first of these errors: shear keeps its direction in it, and steps are long. That of one
/// structure was 1.001, 1.005, 1.009 and 1.012 times that by small steps (hertz.py) at loads of 2, 6, 18 and 100.
constexpr double of_path = 0.5;

}  // namespace

HertzScatter hertz_scatter(double particles, const MatrixXd& logarithms) {
    const auto structures = static_cast<double>(logarithms.cols());
    const double share = particles_of_curves / particles;
    const Eigen::RowVectorXd first = principal_errors.row(0);
    const Eigen::RowVectorXd sizes = first * (logarithms.colwise() - logarithms.rowwise().mean()) / first.squaredNorm();
    const double degrees = degrees_of_curves + structures - 1;
    const double variance = (degrees_of_curves + sizes.squaredNorm() / share) / degrees;

    MatrixXd errors(logarithms.rows(), principal_errors.rows() + 1);
    errors << std::sqrt(variance * share / structures) * principal_errors.transpose(), of_path * first.transpose();
    return {std::move(errors), degrees};
}

}  // namespace coagula::diagnose
