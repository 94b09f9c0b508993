// SPDX-License-Identifier: GPL-3.0-or-later
// Supernodal sparse Cholesky factor (SuiteSparse CHOLMOD), wrapped once; status and input are checked here.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

namespace coagula {

enum class Ordering {
    nested_dissection,  ///< METIS: least fill, but it draws from the C library's random numbers: not to be used by two threads at
                        ///< once
    minimum_degree,     ///< AMD: safe in parallel, good enough for small matrices
};

/// Order of elimination and what the factor will cost; cheap compared with the factorisation.
class EliminationOrder {
public:
    /// Orders the graph of the blocks of a symmetric matrix, such as one block per particle.
    /// @param start, row the lower triangle by columns: blocks row[start[k]] .. row[start[k + 1]] stand in column k, the diagonal
    /// one among them. @param block_size unknowns per block.
    EliminationOrder(std::span<const Index> start, std::span<const Index> row, int block_size, Ordering ordering);

    /// Memory of the factor, predicted from the block column counts [bytes].
    double predicted_memory() const { return predicted_memory_; }
    const std::vector<int>& permutation() const { return permutation_; }

private:
    std::vector<int> permutation_;
    double predicted_memory_ = 0;
};

/// Thrown for a matrix that has a direction of negative or no stiffness.
struct NotPositiveDefinite : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Factor L of a symmetric positive definite matrix: P A P^T = L L^T.
class CholeskyFactor {
public:
    /// @param lower the lower triangle, compressed.
    /// Throws NotPositiveDefinite, or std::runtime_error when memory does not suffice.
    CholeskyFactor(const Eigen::SparseMatrix<double>& lower, const EliminationOrder& order);
    ~CholeskyFactor();
    CholeskyFactor(const CholeskyFactor&) = delete;
    CholeskyFactor& operator=(const CholeskyFactor&) = delete;

    /// A^-1 b for any number of right-hand sides.
    Eigen::MatrixXd solve(Eigen::MatrixXd b) const;

    /// A dense block column of the factor L: `columns` columns from `first_column` on; value[c * rows + r] is its entry in row[r],
    /// column first_column + c. The first `columns` rows are the diagonal block.
    struct SupernodeView {
        int first_column;
        int columns;
        int rows;
        const int* row;
        const double* value;
    };
    void for_each_supernode(const std::function<void(const SupernodeView&)>& visit) const;

    /// Row of the matrix that was eliminated k-th.
    std::vector<int> permutation() const;

    /// Number of pivots of the factor below `threshold`: directions of (almost) no stiffness.
    Index pivots_below(double threshold) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace coagula
