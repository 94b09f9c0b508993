// SPDX-License-Identifier: GPL-3.0-or-later
#include "spline.hpp"

#include <coagula/common/dense.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

/// Second derivatives at the nodes.
Eigen::MatrixXd second_derivatives(const Eigen::VectorXd& nodes, const Eigen::MatrixXd& values) {
    const Eigen::Index last = nodes.size() - 1;
    const Eigen::VectorXd step = nodes.tail(last) - nodes.head(last);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(last + 1, last + 1);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(last + 1, values.cols());
    for (Eigen::Index k = 1; k < last; ++k) {
        matrix(k, k - 1) = step[k - 1] / 6;
        matrix(k, k) = (step[k - 1] + step[k]) / 3;
        matrix(k, k + 1) = step[k] / 6;
        right.row(k) = (values.row(k + 1) - values.row(k)) / step[k] - (values.row(k) - values.row(k - 1)) / step[k - 1];
    }
    matrix.row(0).head(3) << step[1], -(step[0] + step[1]), step[0];
    matrix.row(last).tail(3) << step[last - 1], -(step[last - 2] + step[last - 1]), step[last - 2];
    return dense::solve(matrix, right);
}

}  // namespace

Eigen::MatrixXd spline_interpolate(const Eigen::VectorXd& nodes, const Eigen::MatrixXd& values, const Eigen::VectorXd& x) {
    const Eigen::MatrixXd curvature = second_derivatives(nodes, values);
    Eigen::MatrixXd result(x.size(), values.cols());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), x[i]);
        const Eigen::Index k = std::clamp<Eigen::Index>(above - nodes.begin() - 1, 0, nodes.size() - 2);
        const double step = nodes[k + 1] - nodes[k];
        const double right = (x[i] - nodes[k]) / step;
        const double left = 1 - right;
        result.row(i) =
            left * values.row(k) + right * values.row(k + 1) +
            step * step / 6 *
                ((left * left * left - left) * curvature.row(k) + (right * right * right - right) * curvature.row(k + 1));
    }
    return result;
}

}  // namespace coagula::characterize
