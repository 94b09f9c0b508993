// SPDX-License-Identifier: GPL-3.0-or-later
// Which particles and bonds of a network can carry load.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::mechanics {

/// The part of a network that can carry load.
struct LoadBearing {
    std::vector<Index> particle;  ///< original index of each load-bearing particle that may move
    std::vector<Index> number;    ///< N: place in `particle`, or -1
    std::vector<Index> bond;      ///< original index of each load-bearing bond
};

/// Removes, again and again, what cannot carry load in linear elasticity: a particle with fewer than two bonds, and, where bonds
/// carry no moment, a pair of bonded particles that have one more bond each and do not lie on one line (a chain of two links, whose
/// joints would have to pass a force along two different lines).
/// @param moments whether bonds resist bending or twisting.
/// @param held N flags, or empty: particles fixed to the boundary, which are never removed and get no number.
LoadBearing find_load_bearing(const ContactNetwork& network, const std::vector<bool>& held = {}, bool moments = false);

/// Numbers the particles and lists the bonds along a space-filling (Morton) curve, so that neighbours in space are near in memory:
/// a product with the stiffness matrix of a large network waits for memory and for nothing else. Small networks fit the processor's
/// cache and keep their order.
void sort_along_curve(LoadBearing& kept, const ContactNetwork& network, const Packing& packing);

}  // namespace coagula::mechanics
