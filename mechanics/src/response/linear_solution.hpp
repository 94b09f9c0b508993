// SPDX-License-Identifier: GPL-3.0-or-later
// Solves K u = f of a bonded network, directly or by iteration.
#pragma once

#include "solvers/stiffness.hpp"

#include <coagula/common/progress.hpp>
#include <coagula/mechanics/linear.hpp>

#include <Eigen/Core>

namespace coagula::mechanics {

struct SolvedNetwork {
    Loads motion;
    LinearSolver solver = LinearSolver::direct;  ///< the one used
    double predicted_memory = unset;             ///< of the factor [bytes]
    Index floppy_modes = -1;                     ///< rigid translation included; -1: not counted (iterative)
    int iterations = 0;
    double residual = 0;       ///< |f - K u| / |f|, largest over the strains
    double modulus_error = 0;  ///< estimated relative error of the energy from stopping early
};

/// The displacements and rotations of `network` under each unit strain.
/// @param packing its cell and positions divide the network for the iterative solver. @param kept as in `network`.
/// Throws std::runtime_error when the solver fails.
SolvedNetwork solve_network(const LinearNetwork& network, const Packing& packing, const LoadBearing& kept,
                            const LinearOptions& options, const Progress& progress);

}  // namespace coagula::mechanics
