// SPDX-License-Identifier: GPL-3.0-or-later
// The stiffness matrix of a network as the sparse solver of common takes it.
#pragma once

#include "stiffness.hpp"

#include <coagula/common/cholesky_factor.hpp>

#include <Eigen/SparseCore>

namespace coagula::mechanics {

/// Orders the particles.
EliminationOrder elimination_order(const BlockMatrix& upper, Ordering ordering);

/// Lower triangle by columns of K + shift I. Throws std::runtime_error when it has more entries than CHOLMOD counts.
Eigen::SparseMatrix<double> shifted(const BlockMatrix& upper, double shift);

}  // namespace coagula::mechanics
