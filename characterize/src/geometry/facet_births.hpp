// SPDX-License-Identifier: GPL-3.0-or-later
// When the facets of a power diagram, the polygons between two cells, are reached by growing spheres. Internal.
#pragma once

#include "power_diagram.hpp"

#include <vector>

namespace coagula::characterize {

/// A facet of a counted cell, once for each of its counted cells.
struct FacetBirth {
    int site;                ///< the counted cell
    int neighbour;           ///< the cell beyond
    double birth;            ///< least power of a point of the facet
    double signed_distance;  ///< from the site to the plane of the facet
};

/// Sorted by (site, neighbour).
std::vector<FacetBirth> facet_births(const PowerDiagram& diagram);

/// The least power of a point of the edge, with its geometry.
double edge_birth(const EdgeGeometry& geometry);

}  // namespace coagula::characterize
