// SPDX-License-Identifier: GPL-3.0-or-later
// Factorisations of dense matrices of any size. They stand behind one source: their templates take seconds to compile wherever they
// are included. Matrices whose size is known to the compiler are small, and better factorised where they are.
#pragma once

#include <Eigen/Core>

#include <memory>

namespace coagula::dense {

/// Solution x of A x = b for a regular square A and the columns b, by LU factors with partial pivoting.
Eigen::MatrixXd solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// LU factors with partial pivoting of a regular square matrix, for one right-hand side after the other.
class LuFactors {
public:
    LuFactors() = default;
    explicit LuFactors(const Eigen::MatrixXd& matrix);

    Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXd>> factors_;
};

/// Returns as many orthonormal columns as the matrix has; they span the same if its columns are independent (Householder).
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// Householder reflections with column pivoting.
struct PivotedQr {
    explicit PivotedQr(const Eigen::MatrixXd& matrix);

    Eigen::Index rank;
    Eigen::VectorXi order;  ///< of the columns, those first that span the others best
    Eigen::MatrixXd basis;  ///< rows x rank, orthonormal: spans all columns
};

/// The x with the least |A x - b| for each column b, by the same.
struct LeastSquares {
    LeastSquares(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

    Eigen::Index rank;
    Eigen::MatrixXd solution;
};

/// The pseudoinverse of Moore and Penrose, by complete orthogonal decomposition.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

/// Eigenvalues of a symmetric matrix in ascending order and orthonormal eigenvectors, a column each.
struct SymmetricModes {
    explicit SymmetricModes(const Eigen::MatrixXd& matrix);

    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};

/// The nearest positive semi-definite matrix to a symmetric one: without its negative eigenvalues.
Eigen::MatrixXd nearest_semidefinite(const Eigen::MatrixXd& matrix);

/// Thin singular value decomposition U diag(values) V^T of a matrix with at least as many rows as columns (Jacobi rotations,
/// accurate for small values too). Values descend.
struct SingularValues {
    enum class Vectors { left, right };
    SingularValues(const Eigen::MatrixXd& matrix, Vectors wanted);

    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;  ///< U or V
};

}  // namespace coagula::dense
