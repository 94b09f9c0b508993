// Supernodal sparse Cholesky factor of a block matrix (SuiteSparse CHOLMOD), wrapped once; status and input are checked here.
#pragma once

#include "stiffness.hpp"

#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace coagula::mechanics {

enum class Ordering {
    nested_dissection,  ///< METIS: least fill, but it draws from the C library's random numbers: not to be used by two threads at
                        ///< once
    minimum_degree,     ///< AMD: safe in parallel, good enough for small matrices
};

/// Order of elimination and what the factor will cost; cheap compared with the factorisation.
class EliminationOrder {
public:
    /// Orders the graph of the blocks.
    EliminationOrder(const BlockMatrix& upper, Ordering ordering);

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

/// Factor of K + shift I.
class CholeskyFactor {
public:
    /// Throws NotPositiveDefinite, or std::runtime_error when memory does not suffice.
    CholeskyFactor(const BlockMatrix& upper, double shift, const EliminationOrder& order);
    ~CholeskyFactor();
    CholeskyFactor(const CholeskyFactor&) = delete;
    CholeskyFactor& operator=(const CholeskyFactor&) = delete;

    /// x = (K + shift I)^-1 b for six right-hand sides.
    void solve(const Loads& b, Loads& x) const;
    /// The same for any number of right-hand sides.
    void solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;
    /// The same for one right-hand side.
    void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

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

}  // namespace coagula::mechanics
