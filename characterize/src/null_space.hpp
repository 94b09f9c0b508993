// Rank of a rigidity matrix and random members of its null space.
#pragma once

#include "rigidity_matrix.hpp"

#include <memory>

namespace coagula::characterize {

struct NullSpace {
    std::vector<bool> pinned;  ///< one unknown per dimension: the other columns of the matrix are independent and span its range
    Index dimension = 0;
    Eigen::MatrixXd motions;          ///< random members, as columns: normal random numbers where `pinned`, what follows elsewhere
    double largest_zero = 0;          ///< largest |A x| / |x| of the columns of `motions`
    double smallest_nonzero = unset;  ///< smallest singular value of the columns that are not pinned: no nonzero one of the whole
                                      ///< matrix is smaller
    std::unique_ptr<CholeskyFactor> factor;  ///< of A^T A with the pinned unknowns cut out; none without contacts
};

/// Options as those of measure_rigidity.
NullSpace find_null_space(const RigidityMatrix& matrix, const RigidityOptions& options, const Progress& progress);

}  // namespace coagula::characterize
