// SPDX-License-Identifier: GPL-3.0-or-later
#include "residual_minimisation.hpp"

#include <Eigen/QR>

#include <cmath>
#include <vector>

namespace coagula::mechanics {

KrylovSolution minimise_residual(const LinearMap& matrix, const Eigen::VectorXd& b, double tolerance, int most_iterations) {
    KrylovSolution found{Eigen::VectorXd::Zero(b.size())};
    const double norm = b.norm();
    if (norm == 0) {
        found.residual = 0;
        return found;
    }
    std::vector<Eigen::VectorXd> basis{b / norm};
    Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(most_iterations + 1, most_iterations);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(most_iterations + 1);
    std::vector<Eigen::JacobiRotation<double>> rotations;
    rhs[0] = norm;
    while (found.iterations < most_iterations && found.residual > tolerance) {
        const int k = found.iterations;
        Eigen::VectorXd next = matrix(basis.back());
        const double length = next.norm();
        for (int row = 0; row <= k; ++row) {
            triangle(row, k) = basis[static_cast<std::size_t>(row)].dot(next);
            next -= triangle(row, k) * basis[static_cast<std::size_t>(row)];
        }
        const double left = next.norm();
        triangle(k + 1, k) = left;
        for (int row = 0; row < k; ++row) {
            triangle.col(k).applyOnTheLeft(row, row + 1, rotations[static_cast<std::size_t>(row)].adjoint());
        }
        Eigen::JacobiRotation<double> rotation;
        rotation.makeGivens(triangle(k, k), triangle(k + 1, k));
        triangle.col(k).applyOnTheLeft(k, k + 1, rotation.adjoint());
        rhs.applyOnTheLeft(k, k + 1, rotation.adjoint());
        rotations.push_back(rotation);
        ++found.iterations;
        found.residual = std::abs(rhs[k + 1]) / norm;
        if (!(left > 1e-14 * length)) {
            break;  // the space is exhausted
        }
        basis.emplace_back(next / left);
    }
    const int size = found.iterations;
    // A direction that the matrix does not move has a zero pivot and no part in the solution.
    const Eigen::VectorXd weight = triangle.topLeftCorner(size, size)
                                       .triangularView<Eigen::Upper>()
                                       .toDenseMatrix()
                                       .colPivHouseholderQr()
                                       .solve(rhs.head(size));
    for (int k = 0; k < size; ++k) {
        found.solution += weight[k] * basis[static_cast<std::size_t>(k)];
    }
    return found;
}

}  // namespace coagula::mechanics
