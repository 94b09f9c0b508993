// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_births.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coagula::characterize {

namespace {

/// What one edge says about a facet that it bounds.
struct Piece {
    int site;
    int neighbour;
    double birth;  ///< of the edge
    double signed_distance;
    bool foot_inside;  ///< whether the foot lies on the facet's side of the edge
};

void add_pieces(const PowerDiagram& diagram, const DiagramEdge& edge, std::vector<Piece>& pieces) {
    const EdgeGeometry geometry = measure_edge(diagram, edge);
    const double birth = edge_birth(geometry);
    const auto add = [&](int from, int to, double distance, double foot_distance) {
        const int site = edge.around[static_cast<std::size_t>(from)];
        if (diagram.counted[static_cast<std::size_t>(site)] != 0) {
            const int neighbour = edge.around[static_cast<std::size_t>(to)];
            pieces.push_back({site, neighbour, birth, distance, foot_distance >= 0});
        }
    };
    for (const EdgeSide& side : geometry.sides) {
        add(side.first, side.second, side.first_distance, side.foot_distance);
        add(side.second, side.first, side.second_distance, side.foot_distance);
    }
}

}  // namespace

double edge_birth(const EdgeGeometry& geometry) {
    const bool foot_inside = geometry.height[0] >= 0 && geometry.height[1] >= 0;
    return foot_inside ? geometry.foot_power : std::min(geometry.end_power(0), geometry.end_power(1));
}

std::vector<FacetBirth> facet_births(const PowerDiagram& diagram) {
    std::vector<Piece> pieces;
    pieces.reserve(6 * diagram.edges.size());
    for (const DiagramEdge& edge : diagram.edges) {
        add_pieces(diagram, edge, pieces);
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& one, const Piece& other) {
        return one.site != other.site ? one.site < other.site : one.neighbour < other.neighbour;
    });
    std::vector<FacetBirth> facets;
    for (std::size_t first = 0; first < pieces.size();) {
        const Piece& piece = pieces[first];
        const double radius = diagram.radii[piece.site];
        FacetBirth facet{piece.site, piece.neighbour, std::numeric_limits<double>::infinity(), piece.signed_distance};
        bool foot_inside = true;
        for (; first < pieces.size() && pieces[first].site == facet.site && pieces[first].neighbour == facet.neighbour; ++first) {
            facet.birth = std::min(facet.birth, pieces[first].birth);
            foot_inside = foot_inside && pieces[first].foot_inside;
        }
        if (foot_inside) {
            facet.birth = facet.signed_distance * facet.signed_distance - radius * radius;
        }
        facets.push_back(facet);
    }
    return facets;
}

}  // namespace coagula::characterize
