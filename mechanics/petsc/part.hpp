// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a network that one process has.
#pragma once

#include "response/linear_problem_file.hpp"

#include <vector>

namespace coagula::mechanics {

/// Particles of one brick, those that are bonded to them through `overlap` bonds at most, and all bonds of both. Particles are
/// numbered from zero: the own ones first.
struct Part {
    Index own = 0;
    std::vector<Index> particle;   ///< its number in the problem
    std::vector<Index> neighbour;  ///< of each particle that is not its own: its number when the processes count theirs in turn
    Eigen::Matrix3Xd fraction;
    /// An end that is -1 is held, as in the problem, or lies beyond the neighbours.
    std::vector<LinearBond> bonds;
};

/// @param process of so many. No process needs to hear of another.
Part part_of(const ProblemFile& problem, int process, int processes, int overlap);

}  // namespace coagula::mechanics
