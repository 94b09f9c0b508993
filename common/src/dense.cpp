// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dense.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace coagula::dense {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd solve(const MatrixXd& matrix, const MatrixXd& right) {
    return matrix.partialPivLu().solve(right);
}

LuFactors::LuFactors(const MatrixXd& matrix) : factors_(std::make_shared<Eigen::PartialPivLU<MatrixXd>>(matrix)) {}

VectorXd LuFactors::solve(const VectorXd& right) const {
    return factors_->solve(right);
}

MatrixXd orthonormal(const MatrixXd& columns) {
    const Eigen::HouseholderQR<MatrixXd> qr(columns);
    return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

PivotedQr::PivotedQr(const MatrixXd& matrix) {
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
    rank = qr.rank();
    order = qr.colsPermutation().indices();
    basis = qr.householderQ() * MatrixXd::Identity(matrix.rows(), rank);
}

LeastSquares::LeastSquares(const MatrixXd& matrix, const MatrixXd& right) {
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
    rank = qr.rank();
    solution = qr.solve(right);
}

MatrixXd pseudo_inverse(const MatrixXd& matrix) {
    return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

SymmetricModes::SymmetricModes(const MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
}

MatrixXd nearest_semidefinite(const MatrixXd& matrix) {
    const SymmetricModes modes(matrix);
    return modes.vectors * modes.values.cwiseMax(0).asDiagonal() * modes.vectors.transpose();
}

SingularValues::SingularValues(const MatrixXd& matrix, Vectors wanted) {
    const bool left = wanted == Vectors::left;
    const Eigen::JacobiSVD<MatrixXd, Eigen::HouseholderQRPreconditioner> svd(matrix,
                                                                             left ? Eigen::ComputeThinU : Eigen::ComputeThinV);
    values = svd.singularValues();
    vectors = left ? svd.matrixU() : svd.matrixV();
}

}  // namespace coagula::dense
