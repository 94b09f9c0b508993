// SPDX-License-Identifier: GPL-3.0-or-later
// The void space as a graph: the vertices of the power diagram are pores, its edges the ways between them. Internal.
//
// What is outside all spheres of a diagram can be drawn back, away from the centre of each cell, onto the edges of positive power:
// two points of the void are connected if and only if the edges that they come to are. The diagram of spheres with radii larger by
// g has the void that the centre of a probe of radius g can reach.
#pragma once

#include <coagula/common/image_sets.hpp>

#include "geometry/reduced_diagram.hpp"

namespace coagula::characterize {

struct VoidGraph {
    struct Vertex {
        std::array<int, 4> sites{};
        Eigen::Vector3d position;  ///< in the box
        double power = 0;          ///< of the point for its four sites; -infinity if the tetrahedron is too flat for it to be known
    };
    struct Link {
        std::size_t first = 0;
        std::size_t second = 0;
        Eigen::Vector3i image;      ///< box in which the second vertex lies, seen from the first
        double power = 0;           ///< least power along the edge
        std::array<int, 3> around;  ///< sites whose cells share the edge
    };

    std::vector<Vertex> vertices;
    std::vector<Link> links;  ///< widest first
};

/// The graph of a diagram that counts all particles of a periodic packing in `cell`; it has each vertex and edge of the torus once.
VoidGraph void_graph(const PowerDiagram& diagram, const Cell& cell);

/// For each axis the widest link that, with those wider than it, closes a way that reaches around the box along the axis: its place
/// in VoidGraph::links.
std::array<std::size_t, 3> closing_links(const VoidGraph& graph);

/// For each vertex whether it can be reached, along links no narrower than the given power, from a way around the box.
std::vector<bool> percolating_vertices(const VoidGraph& graph, double power);

}  // namespace coagula::characterize
