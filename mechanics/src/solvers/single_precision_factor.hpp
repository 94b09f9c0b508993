// SPDX-License-Identifier: GPL-3.0-or-later
// A Cholesky factor kept in single precision, for preconditioners: half of the memory, and solves without BLAS calls, which
// would contend for OpenBLAS's buffers when many small factors are used by several threads at once.
#pragma once

#include "six_column_kernels.hpp"
#include "stiffness.hpp"

#include <coagula/common/cholesky_factor.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

class SinglePrecisionFactor {
public:
    /// Factorises in double precision and keeps a rounded copy.
    SinglePrecisionFactor(const BlockMatrix& upper, double shift, const EliminationOrder& order);

    /// Place, among the particles of the matrix, of each in the order of elimination, in which solve() takes their rows.
    std::vector<Index> order() const;

    /// Replaces b by (K + shift I)^-1 b to single precision; six rows for each particle.
    void solve(std::vector<PaddedRow>& b) const;

private:
    struct Supernode {
        int first_column;
        int columns;
        std::size_t rows_start;  ///< of the rows below the diagonal block, in rows_
        int rows;
        std::size_t values_start;  ///< diagonal block (columns x columns), then the rows below, each row contiguous
    };

    SupernodeValues values_of(const Supernode& node) const;

    std::vector<int> permutation_;
    std::vector<Supernode> supernodes_;
    std::vector<int> rows_;
    std::vector<float> values_;
};

}  // namespace coagula::mechanics
