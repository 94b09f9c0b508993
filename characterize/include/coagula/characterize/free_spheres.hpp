// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres that fit into the void, and that can move through it without end.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

/// Diameters [m], with the names and the meaning that they have in Zeo++ (Willems et al., Microporous Mesoporous Mater. 149 (2012)
/// 134).
struct FreeSpheres {
    double included = unset;  ///< D_i: largest sphere that fits into the void
    double free = unset;      ///< D_f: largest sphere that can move from a place to a periodic image of it; 0: not even a
                              ///< point can; NaN in an open packing, which has no images
    double included_along_free = unset;  ///< D_if: largest sphere that fits somewhere along the ways of the free sphere; NaN if
                                         ///< there is none, and for unequal spheres if no straight way leads there
    Eigen::Vector3d free_by_axis =       ///< D_f of ways that end in an image displaced along x, y, z; D_f is the largest
        Eigen::Vector3d::Constant(unset);
};

/// Exact: the void is drawn back onto the edges of the power diagram (void_graph.hpp). Unequal spheres need a diagram for each
/// radius of the probe, about ten in all. In an open packing only the inner particles count. Throws std::invalid_argument if there
/// is no void or, in an open packing, no inner particle.
FreeSpheres measure_free_spheres(const Packing& packing, const Progress& progress = {});

}  // namespace coagula::characterize
