// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dense.hpp>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
namespace dense = coagula::dense;

/// The same numbers in (-1, 1) each time.
MatrixXd mixed(Eigen::Index rows, Eigen::Index columns) {
    return MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index row, Eigen::Index column) {
        return std::sin(1.0 + 3.7 * static_cast<double>(row) + 11.3 * static_cast<double>(column) * static_cast<double>(row + 1));
    });
}

double largest(const MatrixXd& matrix) {
    return matrix.cwiseAbs().maxCoeff();
}

TEST(Dense, SolutionsSatisfyTheirEquations) {
    const MatrixXd matrix = mixed(7, 7);
    const MatrixXd right = mixed(7, 3);
    EXPECT_LT(largest(matrix * dense::solve(matrix, right) - right), 1e-12);
    const dense::LuFactors factors(matrix);
    EXPECT_LT(largest(matrix * factors.solve(right.col(1)) - right.col(1)), 1e-12);
}

TEST(Dense, OrthonormalColumnsSpanTheColumns) {
    const MatrixXd columns = mixed(9, 4);
    const MatrixXd basis = dense::orthonormal(columns);
    EXPECT_LT(largest(basis.transpose() * basis - MatrixXd::Identity(4, 4)), 1e-14);
    EXPECT_LT(largest(columns - basis * (basis.transpose() * columns)), 1e-14);
}

TEST(Dense, PivotedFactorsSeeTheRank) {
    MatrixXd columns = mixed(9, 5);
    columns.col(1) = 3 * columns.col(0) - columns.col(4);
    columns.col(2) *= 100;
    const dense::PivotedQr found(columns);
    EXPECT_EQ(found.rank, 4);
    EXPECT_EQ(found.order[0], 2);
    EXPECT_EQ(found.basis.cols(), 4);
    EXPECT_LT(largest(columns - found.basis * (found.basis.transpose() * columns)), 1e-12);
    EXPECT_EQ(dense::PivotedQr(MatrixXd::Zero(4, 3)).rank, 0);
}

TEST(Dense, LeastSquaresLeaveWhatIsOrthogonal) {
    const MatrixXd matrix = mixed(11, 4);
    const MatrixXd right = mixed(11, 2);
    const dense::LeastSquares fit(matrix, right);
    EXPECT_EQ(fit.rank, 4);
    EXPECT_LT(largest(matrix.transpose() * (right - matrix * fit.solution)), 1e-13);
}

TEST(Dense, PseudoinverseHasThePropertiesOfPenrose) {
    MatrixXd matrix = mixed(8, 5);
    matrix.col(3) = matrix.col(0) + matrix.col(1);
    const MatrixXd inverse = dense::pseudo_inverse(matrix);
    EXPECT_LT(largest(matrix * inverse * matrix - matrix), 1e-13);
    EXPECT_LT(largest(inverse * matrix * inverse - inverse), 1e-13);
    EXPECT_LT(largest(matrix * inverse - (matrix * inverse).transpose()), 1e-13);
    EXPECT_LT(largest(inverse * matrix - (inverse * matrix).transpose()), 1e-13);
}

TEST(Dense, ModesMakeUpASymmetricMatrix) {
    const MatrixXd half = mixed(6, 6);
    const MatrixXd matrix = half + half.transpose();
    const dense::SymmetricModes modes(matrix);
    EXPECT_LT(largest(modes.vectors * modes.values.asDiagonal() * modes.vectors.transpose() - matrix), 1e-13);
    EXPECT_LE(modes.values[0], modes.values[5]);
    ASSERT_LT(modes.values[0], 0);
    const MatrixXd nearest = dense::nearest_semidefinite(matrix);
    EXPECT_GT(dense::SymmetricModes(nearest).values[0], -1e-13);
    // What is taken away are the negative eigenvalues, and nothing else.
    EXPECT_NEAR((nearest - matrix).squaredNorm(), modes.values.cwiseMin(0).squaredNorm(), 1e-12);
}

TEST(Dense, SingularValuesDescend) {
    const MatrixXd matrix = mixed(10, 3) * VectorXd{{1, 1e-3, 1e-9}}.asDiagonal();
    const dense::SingularValues right(matrix, dense::SingularValues::Vectors::right);
    const dense::SingularValues left(matrix, dense::SingularValues::Vectors::left);
    EXPECT_TRUE(right.values[0] > right.values[1] && right.values[1] > right.values[2]);
    EXPECT_LT(largest(right.values - left.values), 1e-15);
    EXPECT_LT(largest(left.vectors * left.values.asDiagonal() * right.vectors.transpose() - matrix), 1e-14);
}

}  // namespace
