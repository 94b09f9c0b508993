// SPDX-License-Identifier: GPL-3.0-or-later
// Rank of a sparse matrix and random members of its null space.
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
    std::unique_ptr<CholeskyFactor> factor;  ///< of A^T A with the pinned unknowns cut out; none of whole_space
};

/// Options as those of measure_rigidity. A matrix of zeros is none of these: see whole_space.
/// @param guess of what to pin, one for each unknown: the better the guess, the better conditioned is what is left.
NullSpace find_null_space(const SparseMap& matrix, const std::vector<bool>& guess, const RigidityOptions& options,
                          const Progress& progress);

/// Null space of a matrix without rows.
NullSpace whole_space(Index unknowns, const RigidityOptions& options);

/// Moves the unknowns that are not pinned so that |A x| becomes least, for several x as columns, with iterative refinement.
void relax(const SparseMap& matrix, const CholeskyFactor& factor, const std::vector<bool>& pinned, Eigen::MatrixXd& x);

/// Normal random numbers for motions.
Eigen::MatrixXd random_motions(Index unknowns, const RigidityOptions& options);

}  // namespace coagula::characterize
