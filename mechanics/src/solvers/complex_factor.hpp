// SPDX-License-Identifier: GPL-3.0-or-later
// L D L^T factor of a complex symmetric matrix (MUMPS, zmumps), wrapped once; status and input are checked here.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <vector>

namespace coagula::mechanics {

using Complex = std::complex<double>;
using ComplexLoads = Eigen::Matrix<Complex, Eigen::Dynamic, 6, Eigen::RowMajor>;  ///< one column per unit strain

/// Analyses a pattern once and factorises matrices of that pattern one after the other.
///
/// There is no pivoting: it is meant for matrices e^{i phi} (A + i B) with A and B positive (semi-)definite, of which elimination
/// in any order lets entries grow by a factor less than 3 (Higham 1998, Math. Comp. 67, 1591).
class ComplexSymmetricFactor {
public:
    /// One triangle of the pattern as pairs of 0-based row and column.
    /// @param permutation row that is eliminated k-th.
    ComplexSymmetricFactor(const std::vector<int>& row, const std::vector<int>& column, const std::vector<int>& permutation);
    ~ComplexSymmetricFactor();
    ComplexSymmetricFactor(const ComplexSymmetricFactor&) = delete;
    ComplexSymmetricFactor& operator=(const ComplexSymmetricFactor&) = delete;

    /// Takes the values in the order of the pattern. Throws std::runtime_error when memory does not suffice or a pivot vanishes.
    void factorise(const std::vector<Complex>& values);

    /// x = A^-1 b for six right-hand sides.
    void solve(const ComplexLoads& b, ComplexLoads& x) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace coagula::mechanics
