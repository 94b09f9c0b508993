// SPDX-License-Identifier: GPL-3.0-or-later
// The same packing in boxes of other shapes.
#pragma once

#include <coagula/common/packing.hpp>

namespace coagula::testing {

/// The same spheres and images with other edge vectors: the columns of `multiples` say how many of the old edges make each new one;
/// its determinant must be 1 or -1.
inline Packing with_other_edges(Packing packing, const Eigen::Matrix3d& multiples) {
    packing.cell = Cell::of_edges(packing.cell.origin(), packing.cell.edges() * multiples, packing.cell.periodicity());
    for (auto position : packing.positions.colwise()) {
        position = packing.cell.wrap(position);
    }
    return packing;
}

/// A tilted description, far from the shortest one.
inline Packing skewed(const Packing& packing) {
    return with_other_edges(packing, (Eigen::Matrix3d() << 1, 1, -2, 0, 1, 1, 0, 0, 1).finished());
}

/// The same with the faces across some edges open.
inline Packing with_periodicity(Packing packing, const std::array<bool, 3>& periodic) {
    packing.cell = Cell::of_edges(packing.cell.origin(), packing.cell.edges(), periodic);
    return packing;
}

}  // namespace coagula::testing
