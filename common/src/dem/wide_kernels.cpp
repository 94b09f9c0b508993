// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled with -mavx2: nothing in here may have external linkage but the table of functions.
#include "wide_kernels.hpp"

#include "four_lanes.hpp"

namespace coagula::dem::detail {

namespace {

struct Here;

}  // namespace

extern const Kernels wide_kernels{add_bond_forces<FourLanes, SingleLane<Here>, SpringForce>, move_particles<FourLanes>,
                                  find_touching<FourLanes, SingleLane<Here>>, find_near<FourLanes, SingleLane<Here>>};

}  // namespace coagula::dem::detail
