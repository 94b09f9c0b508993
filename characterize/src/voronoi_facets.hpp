// The facets of a power diagram: the polygons between two cells. Internal.
#pragma once

#include "power_diagram.hpp"

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::characterize {

/// A facet of a counted cell, once for each of its counted cells.
struct VoronoiFacet {
    int site;       ///< the counted cell
    int neighbour;  ///< the cell beyond
    double area;
    double birth;            ///< least power of a point of the facet
    double signed_distance;  ///< from the site to the plane of the facet
};

/// Sorted by (site, neighbour).
std::vector<VoronoiFacet> voronoi_facets(const PowerDiagram& diagram);

/// The least power of a point of the edge, with its geometry.
double edge_birth(const EdgeGeometry& geometry);

}  // namespace coagula::characterize
