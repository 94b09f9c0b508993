// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangulation.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace coagula::characterize {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// The info of a vertex is the number of its site; that of a cell, the number of the diagram's vertex that is dual to it.
using DelaunayVertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
using DelaunayCell = CGAL::Triangulation_cell_base_with_info_3<int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<DelaunayVertex, DelaunayCell>>;
using RegularVertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using RegularCell = CGAL::Triangulation_cell_base_with_info_3<int, Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Regular = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<RegularVertex, RegularCell>>;

/// A tetrahedron with less than this times (longest edge)^3 is taken for flat.
constexpr double flatness = 1e-11;

constexpr int no_vertex = -1;

/// Vertices of the facet opposite to vertex i of a cell, in the order that turns its normal towards vertex i.
constexpr std::array<std::array<int, 3>, 4> facet_of_cell = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

template <class Triangulated>
void insert_sites(const PowerDiagram& diagram, int first, Triangulated& triangulated) {
    using Point = typename Triangulated::Point;
    std::vector<std::pair<Point, int>> points;
    for (int site = first; site < diagram.positions.cols(); ++site) {
        const Kernel::Point_3 centre(diagram.positions(0, site), diagram.positions(1, site), diagram.positions(2, site));
        if constexpr (std::is_same_v<Triangulated, Regular>) {
            points.emplace_back(Point(centre, diagram.radii[site] * diagram.radii[site]), site);
        } else {
            points.emplace_back(centre, site);
        }
    }
    triangulated.insert(points.begin(), points.end());
}

/// Place and flatness of the vertex. The sites are in ascending order, so that it is the same whichever edge asks for it.
void locate(const PowerDiagram& diagram, DiagramVertex& vertex) {
    const auto& sites = vertex.sites;
    const Eigen::Vector3d origin = diagram.positions.col(sites[0]);
    const double origin_radius = diagram.radii[sites[0]];
    std::array<Eigen::Vector3d, 3> edge;
    Eigen::Vector3d half;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        edge[k] = diagram.positions.col(sites[k + 1]) - origin;
        const double radius = diagram.radii[sites[k + 1]];
        const double squared_length = edge[k].squaredNorm();
        half[static_cast<Index>(k)] = 0.5 * (squared_length + (origin_radius - radius) * (origin_radius + radius));
        longest = std::max(longest, squared_length);
    }
    const Eigen::Vector3d normal = edge[1].cross(edge[2]);
    const double determinant = edge[0].dot(normal);
    const double relative_volume = std::abs(determinant) / (longest * std::sqrt(longest));
    if (relative_volume < flatness) {
        return;
    }
    const Eigen::Vector3d from_origin =
        (half[0] * normal + half[1] * edge[2].cross(edge[0]) + half[2] * edge[0].cross(edge[1])) / determinant;
    vertex.relative_volume = relative_volume;
    vertex.place = origin + from_origin;
    vertex.power = from_origin.squaredNorm() - origin_radius * origin_radius;
}

template <class Triangulated>
void collect_vertices(Triangulated& triangulated, PowerDiagram& diagram) {
    diagram.vertices.clear();
    diagram.vertices.reserve(triangulated.number_of_cells());
    diagram.hull.clear();
    if (triangulated.dimension() < 3) {
        return;
    }
    for (auto cell = triangulated.all_cells_begin(); cell != triangulated.all_cells_end(); ++cell) {
        cell->info() = no_vertex;
        if (int infinite = 0; cell->has_vertex(triangulated.infinite_vertex(), infinite)) {
            const auto& corner = facet_of_cell[static_cast<std::size_t>(infinite)];  // towards the outside
            diagram.hull.push_back(
                {cell->vertex(corner[0])->info(), cell->vertex(corner[1])->info(), cell->vertex(corner[2])->info()});
            continue;
        }
        DiagramVertex vertex;
        for (int k = 0; k < 4; ++k) {
            vertex.sites[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
        }
        if (diagram.counts_any(vertex.sites)) {
            std::sort(vertex.sites.begin(), vertex.sites.end());
            cell->info() = static_cast<int>(diagram.vertices.size());
            diagram.vertices.push_back(vertex);
        }
    }
#pragma omp parallel for schedule(static)
    for (DiagramVertex& vertex : diagram.vertices) {
        locate(diagram, vertex);
    }
    for (auto& triangle : diagram.hull) {
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(diagram.hull.begin(), diagram.hull.end());
}

/// The edges, each once. Cells come in the order in which they were made, whatever their addresses, so that sums over the edges are
/// repeatable to the last bit; CGAL's own lists of facets compare addresses.
template <class Triangulated>
void collect_edges(const Triangulated& triangulated, PowerDiagram& diagram) {
    diagram.edges.clear();
    diagram.edges.reserve(2 * diagram.vertices.size());  // four facets to a cell, each in two
    for (const auto& cell : triangulated.finite_cell_handles()) {
        for (int opposite = 0; opposite < 4; ++opposite) {
            const auto other = cell->neighbor(opposite);
            if (cell->info() == no_vertex || cell->info() >= other->info()) {
                continue;
            }
            const auto& corner = facet_of_cell[static_cast<std::size_t>(opposite)];
            DiagramEdge edge{{cell->vertex(corner[0])->info(), cell->vertex(corner[1])->info(), cell->vertex(corner[2])->info()},
                             {cell->vertex(opposite)->info(), triangulated.mirror_vertex(cell, opposite)->info()},
                             {cell->info(), other->info()}};
            if (diagram.counts_any(edge.around)) {
                std::rotate(edge.around.begin(), std::min_element(edge.around.begin(), edge.around.end()), edge.around.end());
                if (edge.around[1] > edge.around[2]) {
                    std::swap(edge.around[1], edge.around[2]);
                    std::swap(edge.apex[0], edge.apex[1]);
                    std::swap(edge.end[0], edge.end[1]);
                }
                diagram.edges.push_back(edge);
            }
        }
    }
}

}  // namespace

struct Triangulation::Implementation {
    std::variant<Delaunay, Regular> triangulated;
    int inserted = 0;
};

Triangulation::Triangulation(bool equal_radii) : implementation_(std::make_unique<Implementation>()) {
    if (!equal_radii) {
        implementation_->triangulated.emplace<Regular>();
    }
}

Triangulation::~Triangulation() = default;

void Triangulation::insert(const PowerDiagram& diagram) {
    std::visit([&](auto& triangulated) { insert_sites(diagram, implementation_->inserted, triangulated); },
               implementation_->triangulated);
    implementation_->inserted = static_cast<int>(diagram.positions.cols());
}

void Triangulation::find_vertices(PowerDiagram& diagram) {
    std::visit([&](auto& triangulated) { collect_vertices(triangulated, diagram); }, implementation_->triangulated);
}

void Triangulation::find_edges(PowerDiagram& diagram) const {
    std::visit([&](const auto& triangulated) { collect_edges(triangulated, diagram); }, implementation_->triangulated);
}

}  // namespace coagula::characterize
