// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells by a diagram which is there already. Internal.
#pragma once

#include <coagula/characterize/voronoi_cells.hpp>

#include "reduced_diagram.hpp"

namespace coagula::characterize {

VoronoiCells measure_voronoi_cells(const ReducedDiagram& reduced);
VoronoiFaces measure_voronoi_faces(const ReducedDiagram& reduced);

}  // namespace coagula::characterize
