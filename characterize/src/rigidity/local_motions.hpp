// SPDX-License-Identifier: GPL-3.0-or-later
// Floppy motions of few particles, found without a factor of the whole network.
#pragma once

#include "rigidity_matrix.hpp"

#include <vector>

namespace coagula::characterize {

/// Unknowns to pin so that nothing moves without stiffness: a guess. Particles are eliminated from A^T A, those with the fewest
/// neighbours first, until all that are left have many; an unknown that finds no stiffness on its way is pinned. What is left is
/// taken for rigid: one of its particles is held in each connected part.
/// @param turns whether the parts that are left can turn as a whole.
std::vector<bool> guess_pinned(const RigidityMatrix& matrix, bool turns);

}  // namespace coagula::characterize
