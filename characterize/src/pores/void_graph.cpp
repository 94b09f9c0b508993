// SPDX-License-Identifier: GPL-3.0-or-later
#include "void_graph.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace coagula::characterize {

namespace {

/// A tetrahedron of the torus: particles and their images, seen from the first.
using Key = std::array<int, 16>;

/// One of the two ends of an edge as the diagram has it.
struct End {
    Key key{};
    Eigen::Vector3i image;  ///< of the first particle of the key
    VoidGraph::Vertex vertex;
};

std::vector<Eigen::Vector3i> images_of_sites(const PowerDiagram& diagram, const Cell& cell) {
    std::vector<Eigen::Vector3i> images;
    for (std::size_t site = 0; site < diagram.particle.size(); ++site) {
        const Eigen::Vector3d shift =
            diagram.positions.col(static_cast<Index>(site)) - diagram.positions.col(diagram.particle[site]);
        images.emplace_back(cell.in_edges(shift).array().round().cast<int>());
    }
    return images;
}

End make_end(const PowerDiagram& diagram, const std::vector<Eigen::Vector3i>& images, const DiagramEdge& edge,
             const EdgeGeometry& geometry, std::size_t which) {
    End end;
    std::array<int, 4> sites = {edge.around[0], edge.around[1], edge.around[2], edge.apex[which]};
    const auto entry = [&](int site) {
        const Eigen::Vector3i& image = images[static_cast<std::size_t>(site)];
        return std::array<int, 4>{diagram.particle[static_cast<std::size_t>(site)], image[0], image[1], image[2]};
    };
    std::sort(sites.begin(), sites.end(), [&](int one, int other) { return entry(one) < entry(other); });
    end.image = images[static_cast<std::size_t>(sites[0])];
    for (std::size_t k = 0; k < 4; ++k) {
        const std::array<int, 4> member = entry(sites[k]);
        end.key[4 * k] = member[0];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            end.key[4 * k + axis + 1] = member[axis + 1] - end.image[static_cast<Index>(axis)];
        }
    }
    const bool known = geometry.relative_volume[which] > well_conditioned;
    end.vertex = {sites, known ? geometry.end[which] : Eigen::Vector3d(diagram.positions.col(sites[0])),
                  known ? geometry.end_power(which) : -std::numeric_limits<double>::infinity()};
    return end;
}

double least_power(const EdgeGeometry& geometry) {
    const bool holds_foot = geometry.height[0] >= 0 && geometry.height[1] >= 0;
    return holds_foot ? geometry.foot_power : std::min(geometry.end_power(0), geometry.end_power(1));
}

/// Whether this copy of an edge of the torus is the one that counts: its particle of lowest number is no image.
bool is_chosen(const PowerDiagram& diagram, const DiagramEdge& edge) {
    const auto particle = [&](int site) { return diagram.particle[static_cast<std::size_t>(site)]; };
    const auto lowest =
        *std::min_element(edge.around.begin(), edge.around.end(), [&](int a, int b) { return particle(a) < particle(b); });
    return std::any_of(edge.around.begin(), edge.around.end(),
                       [&](int site) { return particle(site) == particle(lowest) && site == particle(site); });
}

/// The number of each end's vertex; ends of one tetrahedron have the same. Fills the vertices.
std::vector<std::size_t> number_vertices(std::vector<End>& ends, const Cell& cell, VoidGraph& graph) {
    std::vector<std::size_t> order(ends.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
        return ends[one].key != ends[other].key ? ends[one].key < ends[other].key : one < other;
    });
    std::vector<std::size_t> number(ends.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const End& end = ends[order[k]];
        if (k == 0 || ends[order[k - 1]].key != end.key) {
            graph.vertices.push_back(end.vertex);
            graph.vertices.back().position -= cell.edges() * end.image.cast<double>();
        }
        number[order[k]] = graph.vertices.size() - 1;
    }
    return number;
}

}  // namespace

VoidGraph void_graph(const PowerDiagram& diagram, const Cell& cell) {
    const std::vector<Eigen::Vector3i> images = images_of_sites(diagram, cell);
    VoidGraph graph;
    std::vector<End> ends;
    for (const DiagramEdge& edge : diagram.edges) {
        if (is_chosen(diagram, edge)) {
            const EdgeGeometry geometry = measure_edge(diagram, edge);
            ends.push_back(make_end(diagram, images, edge, geometry, 0));
            ends.push_back(make_end(diagram, images, edge, geometry, 1));
            graph.links.push_back({0, 0, ends.back().image - ends[ends.size() - 2].image, least_power(geometry), edge.around});
        }
    }
    const std::vector<std::size_t> number = number_vertices(ends, cell, graph);
    for (std::size_t k = 0; k < graph.links.size(); ++k) {
        graph.links[k].first = number[2 * k];
        graph.links[k].second = number[2 * k + 1];
    }
    std::stable_sort(graph.links.begin(), graph.links.end(),
                     [](const VoidGraph::Link& one, const VoidGraph::Link& other) { return one.power > other.power; });
    return graph;
}

std::array<std::size_t, 3> closing_links(const VoidGraph& graph) {
    const std::size_t none = graph.links.size();
    std::array<std::size_t, 3> closing = {none, none, none};
    ImageSets sets(std::ssize(graph.vertices));
    for (std::size_t k = 0; k < graph.links.size(); ++k) {
        const VoidGraph::Link& link = graph.links[k];
        const Eigen::Vector3i winding = sets.join(link.first, link.second, link.image);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (closing[axis] == none && winding[static_cast<Index>(axis)] != 0) {
                closing[axis] = k;
            }
        }
    }
    require(std::ranges::count(closing, none) == 0, "the void graph of a periodic packing must reach around the box");
    return closing;
}

std::vector<bool> percolating_vertices(const VoidGraph& graph, double power) {
    ImageSets sets(std::ssize(graph.vertices));
    std::vector<std::size_t> on_loops;
    for (const VoidGraph::Link& link : graph.links) {
        if (link.power < power) {
            break;
        }
        if (!sets.join(link.first, link.second, link.image).isZero()) {
            on_loops.push_back(link.first);
        }
    }
    std::vector<bool> percolating_root(graph.vertices.size(), false);
    for (const std::size_t vertex : on_loops) {
        percolating_root[sets.find(vertex).root] = true;
    }
    std::vector<bool> percolating(graph.vertices.size());
    for (std::size_t vertex = 0; vertex < percolating.size(); ++vertex) {
        percolating[vertex] = percolating_root[sets.find(vertex).root];
    }
    return percolating;
}

}  // namespace coagula::characterize
