// SPDX-License-Identifier: GPL-3.0-or-later
// The power diagram of a packing in units of its mean radius: what several measures start from. Internal.
#pragma once

#include "power_diagram.hpp"

namespace coagula::characterize {

/// The packing with its lengths divided by `unit`; a tilted box by the shortest vectors of its lattice.
Packing in_units_of(double unit, const Packing& packing);

struct ReducedDiagram {
    double unit = 1;  ///< mean radius r0 [m]
    Packing packing;  ///< lengths over r0
    PowerDiagram
        diagram;  ///< all particles are counted, or the inner ones where there is a free surface; edges around counted ones only

    /// N flags.
    std::vector<bool> inner() const { return {diagram.counted.begin(), diagram.counted.begin() + packing.size()}; }
    Index inner_count() const;
};

/// The diagram of a packing that passed check(). Where no particle is inner, it has no edges.
ReducedDiagram reduced_diagram(const Packing& packing);

/// The diagram of spheres whose radii have grown by `growth`, with the counted cells of `original`.
PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth, double margin);

/// Throws NotApplicable when no particle is inner.
void require_inner(const ReducedDiagram& reduced);

}  // namespace coagula::characterize
