// SPDX-License-Identifier: GPL-3.0-or-later
// The sphere between others. Internal.
#pragma once

#include <Eigen/LU>

#include <cmath>
#include <optional>

namespace coagula::characterize {

template <int Dimension>
struct Ball {
    Eigen::Matrix<double, Dimension, 1> centre;
    double radius;
};

/// The sphere that touches Dimension + 1 spheres from outside (the problem of Apollonius): |x - p_k| = r_k + rho. The differences
/// to the first of the equations are linear, x = u - rho v, and leave a quadratic equation for rho. Nothing if there is none.
template <int Dimension>
std::optional<Ball<Dimension>> touching_sphere(const Eigen::Matrix<double, Dimension, Dimension + 1>& centres,
                                               const Eigen::Matrix<double, Dimension + 1, 1>& radii) {
    using Vector = Eigen::Matrix<double, Dimension, 1>;
    const Vector origin = centres.col(0);
    const double r0 = radii[0];
    Eigen::Matrix<double, Dimension, Dimension> differences;
    Vector constant;
    Vector slope;
    for (int k = 0; k < Dimension; ++k) {
        const Vector difference = centres.col(k + 1) - origin;
        const double radius = radii[k + 1];
        differences.row(k) = difference;
        constant[k] = 0.5 * (difference.squaredNorm() - (radius - r0) * (radius + r0));
        slope[k] = radius - r0;
    }
    const Eigen::PartialPivLU<Eigen::Matrix<double, Dimension, Dimension>> factors(differences);
    const Vector u = factors.solve(constant);
    const Vector v = factors.solve(slope);
    const double a = 1 - v.squaredNorm();
    const double half = u.dot(v) + r0;
    const double c = r0 * r0 - u.squaredNorm();
    const double discriminant = half * half - a * c;
    if (!(discriminant >= 0)) {
        return std::nullopt;
    }
    const double rho = -c / (half + std::sqrt(discriminant));  // the root that stays finite when the radii are equal and a = 1
    if (!(rho > 0) || !std::isfinite(rho)) {
        return std::nullopt;
    }
    return Ball<Dimension>{origin + u - rho * v, rho};
}

}  // namespace coagula::characterize
