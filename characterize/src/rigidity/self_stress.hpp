// SPDX-License-Identifier: GPL-3.0-or-later
// States of self-stress of a network that has few of them.
#pragma once

#include "rigidity_matrix.hpp"

#include <optional>

namespace coagula::characterize {

struct SelfStress {
    Index dimension = 0;              ///< independent states
    Eigen::VectorXd redundancy;       ///< diagonal of the projector onto them, for each row of the rigidity matrix
    double largest_zero = 0;          ///< largest |A x| / |x| of random floppy motions
    double smallest_nonzero = unset;  ///< lower estimate of the smallest nonzero singular value of A
};

/// Finds the states by Cholesky factors of A A^T, which has fewer rows than A^T A where contacts are few, and is nearly regular
/// where few of them are redundant. Returns nothing if there are too many states, or if their number cannot be told this way.
std::optional<SelfStress> find_self_stress(const RigidityMatrix& matrix, const RigidityOptions& options, const Progress& progress);

}  // namespace coagula::characterize
