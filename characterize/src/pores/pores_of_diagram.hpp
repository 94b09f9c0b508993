// SPDX-License-Identifier: GPL-3.0-or-later
// Pores by a diagram which is there already. Internal.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/characterize/covering_spheres.hpp>
#include <coagula/characterize/delaunay_pores.hpp>
#include <coagula/characterize/free_spheres.hpp>
#include <coagula/characterize/pore_sizes.hpp>

#include "geometry/reduced_diagram.hpp"

namespace coagula::characterize {

/// @param blocks of the counted particles, or none (count 0).
PoreSizes measure_pores(const ReducedDiagram& reduced, const PoreOptions& options, const Blocks& blocks, const Progress& progress);

CoveringSpheres measure_covering_spheres(const ReducedDiagram& reduced, const CoveringOptions& options, const Blocks& blocks,
                                         const Progress& progress);
DelaunayPores measure_delaunay_pores(const ReducedDiagram& reduced, Index radii);
FreeSpheres measure_free_spheres(const ReducedDiagram& reduced, const Progress& progress);

}  // namespace coagula::characterize
