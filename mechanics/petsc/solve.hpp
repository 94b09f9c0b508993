// SPDX-License-Identifier: GPL-3.0-or-later
// Solves the problem of a network together with other processes.
#pragma once

#include "part.hpp"

namespace coagula::mechanics {

/// The motion of the particles that this process owns, and the summary that all processes find.
struct SharedSolution {
    Loads motion;
    SolutionSummary summary;
};

/// Conjugate gradients for all six loads in one vector, by the additive Schwarz preconditioner of the builtin iterative solver.
/// PETSc's options of a KSP apply. Throws std::runtime_error where the network is too close to losing its stiffness.
SharedSolution solve_together(const ProblemFile& problem, const Part& part);

}  // namespace coagula::mechanics
