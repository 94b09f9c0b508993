#include "hertz_scatter.hpp"

#include "hertz_curve.hpp"

#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

using Eigen::MatrixXd;

// tests/benchmark/hertz_scatter.py measures what the next constants state.
constexpr double particles_of_scatter = 400;  ///< in a structure of which the next hold
/// Principal errors of the logarithm at the nodes, the largest first.
const Eigen::Matrix<double, 3, hertz_axis.count> principal_errors{
    {0, 0, -0.0004, -0.0009, 0.0103, 0.0204, 0.0234, 0.0242, 0.0243},
    {0, 0, -0.0003, 0.0015, 0.0056, 0.0031, -0.0001, -0.0024, -0.0025},
    {0, 0, -0.0004, 0.0020, 0.0019, -0.0026, -0.0011, 0.0008, 0.0016}};
/// As much as that scale weighs.
constexpr double stated_degrees = 6;
/// Of the curve itself, over the first of these errors: secants in proportion instead of the path that shear takes while contacts
/// stiffen. Mean over the structures: 1.014, 1.018, 1.014 and 1.007 of it at loads of 5, 16, 50 and 500.
constexpr double of_path = 0.6;

}  // namespace

HertzScatter hertz_scatter(double particles, const MatrixXd& logarithms) {
    const auto structures = static_cast<double>(logarithms.cols());
    const double share = particles_of_scatter / particles;
    const Eigen::RowVectorXd first = principal_errors.row(0);
    const Eigen::RowVectorXd sizes = first * (logarithms.colwise() - logarithms.rowwise().mean()) / first.squaredNorm();
    const double degrees = stated_degrees + structures - 1;
    const double variance = (stated_degrees + sizes.squaredNorm() / share) / degrees;

    MatrixXd errors(logarithms.rows(), principal_errors.rows() + 1);
    errors << std::sqrt(variance * share / structures) * principal_errors.transpose(), of_path * first.transpose();
    return {std::move(errors), degrees};
}

}  // namespace coagula::diagnose
