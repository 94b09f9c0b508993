#include "power_diagram.hpp"

#include <coagula/common/checks.hpp>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace coagula::characterize {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using DelaunayVertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<DelaunayVertex>>;
using RegularVertex = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using RegularCell = CGAL::Regular_triangulation_cell_base_3<Kernel>;
using Regular = CGAL::Regular_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<RegularVertex, RegularCell>>;

/// A tetrahedron or triangle with less than this times (longest edge)^n is taken for flat.
constexpr double flatness = 1e-11;

/// More sites than this do not fit into the memory of the machines this is made for.
constexpr double most_sites = 3e7;

/// Vertices of the facet opposite to vertex i of a cell, in the order that turns its normal towards vertex i.
constexpr std::array<std::array<int, 3>, 4> facet_of_cell = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

template <class Triangulation>
void collect_edges(const Triangulation& triangulation, PowerDiagram& diagram) {
    if (triangulation.dimension() < 3) {
        return;
    }
    const auto counted = [&](int site) { return diagram.counted[static_cast<std::size_t>(site)] != 0; };
    for (const auto& facet : triangulation.finite_facets()) {
        auto [cell, opposite] = facet;
        auto [other_cell, other_opposite] = triangulation.mirror_facet(facet);
        if (triangulation.is_infinite(cell)) {
            std::swap(cell, other_cell);
            std::swap(opposite, other_opposite);
        }
        const auto& corner = facet_of_cell[static_cast<std::size_t>(opposite)];
        const std::array<int, 3> around = {cell->vertex(corner[0])->info(), cell->vertex(corner[1])->info(),
                                           cell->vertex(corner[2])->info()};
        if (triangulation.is_infinite(other_cell)) {
            diagram.hull.push_back({around[0], around[2], around[1]});
        } else if (std::any_of(around.begin(), around.end(), counted)) {
            diagram.edges.push_back({around, {cell->vertex(opposite)->info(), other_cell->vertex(other_opposite)->info()}});
        }
    }
}

/// Which of its two cells a facet is reported from, and hence the order and sense of edges and hull, depends on memory addresses in
/// CGAL. A fixed order makes sums over them repeatable to the last bit.
void put_in_order(PowerDiagram& diagram) {
    for (DiagramEdge& edge : diagram.edges) {
        auto& around = edge.around;
        std::rotate(around.begin(), std::min_element(around.begin(), around.end()), around.end());
        if (around[1] > around[2]) {
            std::swap(around[1], around[2]);
            std::swap(edge.apex[0], edge.apex[1]);
        }
    }
    std::sort(diagram.edges.begin(), diagram.edges.end(),
              [](const DiagramEdge& one, const DiagramEdge& other) { return one.around < other.around; });
    for (auto& triangle : diagram.hull) {
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(diagram.hull.begin(), diagram.hull.end());
}

template <class Triangulation>
void triangulate(PowerDiagram& diagram) {
    using Point = typename Triangulation::Point;
    std::vector<std::pair<Point, int>> points;
    points.reserve(diagram.counted.size());
    for (int site = 0; site < diagram.positions.cols(); ++site) {
        const Kernel::Point_3 centre(diagram.positions(0, site), diagram.positions(1, site), diagram.positions(2, site));
        if constexpr (std::is_same_v<Triangulation, Regular>) {
            points.emplace_back(Point(centre, diagram.radii[site] * diagram.radii[site]), site);
        } else {
            points.emplace_back(centre, site);
        }
    }
    const Triangulation triangulation(points.begin(), points.end());
    diagram.edges.clear();
    diagram.hull.clear();
    collect_edges(triangulation, diagram);
    put_in_order(diagram);
}

void find_edges(PowerDiagram& diagram) {
    const bool equal = diagram.radii.minCoeff() == diagram.radii.maxCoeff();
    equal ? triangulate<Delaunay>(diagram) : triangulate<Regular>(diagram);
}

/// The point with the same power for four sites. The sites are taken in a fixed order, so that all four triangles of a tetrahedron
/// find the same point, or all find it flat.
/// Returns the relative volume of the tetrahedron, or 0 if it is flat.
double find_vertex(const PowerDiagram& diagram, std::array<int, 4> sites, Eigen::Vector3d& vertex) {
    std::sort(sites.begin(), sites.end());
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
        return 0;
    }
    vertex = origin + (half[0] * normal + half[1] * edge[2].cross(edge[0]) + half[2] * edge[0].cross(edge[1])) / determinant;
    return relative_volume;
}

/// Radius of the ball about a vertex which a site no larger than `largest_radius` must enter in order to change that vertex.
double conflict_radius(const EdgeGeometry& geometry, std::size_t which, double largest_radius) {
    return std::sqrt(std::max(0.0, geometry.end_power(which) + largest_radius * largest_radius));
}

/// How wide the layer of images must be for all found vertices to be right; infinite if a counted cell is unbounded.
double required_margin(const PowerDiagram& diagram, const Eigen::Array3d& lengths) {
    for (const auto& triangle : diagram.hull) {
        for (const int site : triangle) {
            if (diagram.counted[static_cast<std::size_t>(site)] != 0) {
                return std::numeric_limits<double>::infinity();
            }
        }
    }
    const double largest_radius = diagram.radii.maxCoeff();
    double margin = diagram.edges.empty() ? std::numeric_limits<double>::infinity() : 0.0;
#pragma omp parallel for schedule(static) reduction(max : margin)
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        for (std::size_t which = 0; which < 2; ++which) {
            if (!geometry.is_flat(which)) {
                const Eigen::Array3d end = geometry.end[which];
                const double beyond = std::max((-end).maxCoeff(), (end - lengths).maxCoeff());
                margin = std::max(margin, beyond + conflict_radius(geometry, which, largest_radius));
            }
        }
    }
    return margin;
}

/// The particles and their images within `margin` of the box.
PowerDiagram periodic_sites(const Packing& packing, const Eigen::VectorXd& radii, double margin) {
    const Eigen::Array3d lengths = packing.cell.lengths();
    const Index particles = packing.size();
    require(static_cast<double>(particles) * (1 + 2 * margin / lengths).prod() < most_sites,
            "the box is too elongated for its number of particles: their Voronoi cells reach through too many periodic images");
    const Eigen::Array3i turns = (margin / lengths).ceil().cast<int>();
    std::vector<Eigen::Vector3d> positions;
    std::vector<double> site_radii(radii.begin(), radii.end());
    PowerDiagram diagram;
    diagram.particle.resize(static_cast<std::size_t>(particles));
    std::iota(diagram.particle.begin(), diagram.particle.end(), 0);
    for (Index i = 0; i < particles; ++i) {
        positions.emplace_back(packing.cell.wrap(packing.positions.col(i)) - packing.cell.origin());
    }
    for (Index i = 0; i < particles; ++i) {
        for (int x = -turns[0]; x <= turns[0]; ++x) {
            for (int y = -turns[1]; y <= turns[1]; ++y) {
                for (int z = -turns[2]; z <= turns[2]; ++z) {
                    const Eigen::Array3d image = positions[static_cast<std::size_t>(i)].array() + Eigen::Array3d(x, y, z) * lengths;
                    if ((x != 0 || y != 0 || z != 0) && (image >= -margin).all() && (image <= lengths + margin).all()) {
                        positions.emplace_back(image);
                        site_radii.push_back(radii[i]);
                        diagram.particle.push_back(static_cast<int>(i));
                    }
                }
            }
        }
    }
    const auto sites = static_cast<Index>(positions.size());
    diagram.positions = Eigen::Map<const Eigen::Matrix3Xd>(positions.front().data(), 3, sites);
    diagram.radii = Eigen::Map<const Eigen::VectorXd>(site_radii.data(), sites);
    diagram.counted.assign(positions.size(), 0);
    std::fill_n(diagram.counted.begin(), particles, char{1});
    diagram.margin = margin;
    return diagram;
}

/// Whether a ball lies in the intersection of half spaces normals^T x <= offsets.
class ConvexHull {
public:
    explicit ConvexHull(const PowerDiagram& diagram) {
        const auto facets = static_cast<Index>(diagram.hull.size());
        normals_.resize(3, facets);
        offsets_.resize(facets);
        for (Index facet = 0; facet < facets; ++facet) {
            const auto& corner = diagram.hull[static_cast<std::size_t>(facet)];
            const Eigen::Vector3d origin = diagram.positions.col(corner[0]);
            const Eigen::Vector3d first = diagram.positions.col(corner[1]) - origin;
            const Eigen::Vector3d second = diagram.positions.col(corner[2]) - origin;
            normals_.col(facet) = first.cross(second).stableNormalized();
            offsets_[facet] = normals_.col(facet).dot(origin);
        }
        centre_ = diagram.positions.rowwise().mean();
        inner_radius_ = (offsets_ - normals_.transpose() * centre_).minCoeff();
    }

    bool contains_ball(const Eigen::Vector3d& centre, double radius) const {
        return (centre - centre_).norm() + radius <= inner_radius_ ||
               (offsets_ - normals_.transpose() * centre).minCoeff() >= radius * (1 - 1e-9);
    }

private:
    Eigen::Matrix3Xd normals_;
    Eigen::VectorXd offsets_;
    Eigen::Vector3d centre_;
    double inner_radius_ = 0;  ///< of a ball about centre_: spares most points the test against all facets
};

}  // namespace

namespace {

/// The three sites around an edge, relative to the first, with the foot of the edge in their plane.
struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;
    std::array<double, 3> radius{};
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector; zero if the triangle is flat
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();    ///< the point in the plane with equal power for the three sites

    bool is_flat() const { return normal.isZero(0); }
};

Triangle make_triangle(const PowerDiagram& diagram, const std::array<int, 3>& around) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        triangle.corner[k] = diagram.positions.col(around[k]) - diagram.positions.col(around[0]);
        triangle.radius[k] = diagram.radii[around[k]];
    }
    const Eigen::Vector3d& u = triangle.corner[1];
    const Eigen::Vector3d& v = triangle.corner[2];
    const double uu = u.squaredNorm();
    const double vv = v.squaredNorm();
    const double uv = u.dot(v);
    const Eigen::Vector3d normal = u.cross(v);
    const double squared_area = normal.squaredNorm();
    if (squared_area <= flatness * flatness * uu * vv) {
        return triangle;
    }
    const auto& [r0, r1, r2] = triangle.radius;
    const double f = 0.5 * (uu + (r0 - r1) * (r0 + r1));
    const double g = 0.5 * (vv + (r0 - r2) * (r0 + r2));
    triangle.foot = ((f * vv - g * uv) * u + (g * uu - f * uv) * v) / squared_area;
    triangle.normal = normal / std::sqrt(squared_area);
    return triangle;
}

EdgeSide make_side(const Triangle& triangle, int first, int second) {
    const auto i = static_cast<std::size_t>(first);
    const auto j = static_cast<std::size_t>(second);
    const Eigen::Vector3d line = triangle.corner[j] - triangle.corner[i];
    const double length = line.norm();
    const double shift = (triangle.radius[i] - triangle.radius[j]) * (triangle.radius[i] + triangle.radius[j]) / length;
    EdgeSide side;
    side.first = first;
    side.second = second;
    side.first_distance = 0.5 * (length + shift);
    side.second_distance = 0.5 * (length - shift);
    side.foot_distance = triangle.normal.dot(line.cross(triangle.foot - triangle.corner[i])) / length;
    return side;
}

}  // namespace

EdgeGeometry measure_edge(const PowerDiagram& diagram, const DiagramEdge& edge) {
    const Triangle triangle = make_triangle(diagram, edge.around);
    EdgeGeometry geometry;
    geometry.sides = {make_side(triangle, 0, 1), make_side(triangle, 1, 2), make_side(triangle, 2, 0)};
    geometry.foot_power = triangle.foot.squaredNorm() - triangle.radius[0] * triangle.radius[0];
    for (std::size_t which = 0; which < 2; ++which) {
        Eigen::Vector3d& end = geometry.end[which];
        const std::array<int, 4> sites = {edge.around[0], edge.around[1], edge.around[2], edge.apex[which]};
        geometry.relative_volume[which] = triangle.is_flat() ? 0.0 : find_vertex(diagram, sites, end);
        if (geometry.is_flat(which)) {
            geometry.height[which] = 0;
            continue;
        }
        const double above = triangle.normal.dot(end - diagram.positions.col(edge.around[0]));
        geometry.height[which] = which == 0 ? above : -above;
    }
    return geometry;
}

/// The centre of a nearly flat tetrahedron is ill-conditioned. The largest of all spheres has its centre inside its tetrahedron; if
/// that one is flat, a neighbour has the same sphere but for the square of the flatness.
constexpr double well_conditioned = 1e-6;

double largest_vertex_power(const PowerDiagram& diagram) {
    double largest = -std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        for (std::size_t which = 0; which < 2; ++which) {
            if (geometry.relative_volume[which] > well_conditioned) {
                largest = std::max(largest, geometry.end_power(which));
            }
        }
    }
    return largest;
}

DiagramVertex largest_vertex(const PowerDiagram& diagram) {
    DiagramVertex largest;
    largest.power = -std::numeric_limits<double>::infinity();
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        for (std::size_t which = 0; which < 2; ++which) {
            if (geometry.relative_volume[which] > well_conditioned && geometry.end_power(which) > largest.power) {
                largest = {{edge.around[0], edge.around[1], edge.around[2], edge.apex[which]}, geometry.end_power(which)};
            }
        }
    }
    return largest;
}

double power_of_vertex(const PowerDiagram& diagram, const std::array<int, 4>& sites, double growth) {
    const Eigen::Vector3d origin = diagram.positions.col(sites[0]);
    const double radius = diagram.radii[sites[0]] + growth;
    Eigen::Matrix3d edges;
    Eigen::Vector3d half;
    for (int k = 0; k < 3; ++k) {
        const int site = sites[static_cast<std::size_t>(k + 1)];
        const double other = diagram.radii[site] + growth;
        edges.row(k) = diagram.positions.col(site) - origin;
        half[k] = 0.5 * (edges.row(k).squaredNorm() + (radius - other) * (radius + other));
    }
    const Eigen::Vector3d vertex = edges.partialPivLu().solve(half);
    return vertex.allFinite() ? vertex.squaredNorm() - radius * radius : std::numeric_limits<double>::quiet_NaN();
}

PowerDiagram periodic_diagram(const Packing& packing, const Eigen::VectorXd& radii, double margin) {
    const auto particles = static_cast<double>(packing.size());
    if (margin <= 0) {
        // Somewhere along the longest side is a slab of thickness length / particles without a centre: some cells are that large.
        const double slab = packing.cell.lengths().maxCoeff() / particles;
        margin = std::max(2.5 * std::cbrt(packing.cell.volume() / particles), 0.5 * slab);
    }
    while (true) {
        PowerDiagram diagram = periodic_sites(packing, radii, margin);
        find_edges(diagram);
        const double required = required_margin(diagram, packing.cell.lengths());
        if (required <= margin) {
            return diagram;
        }
        // While cells are still cut off by the rim, the requirement is far too high: approach it in steps.
        margin = std::min(1.001 * required, 1.5 * margin);
    }
}

PowerDiagram open_diagram(const Packing& packing, const Eigen::VectorXd& radii, std::vector<char> counted) {
    PowerDiagram diagram;
    diagram.positions = packing.positions.colwise() - packing.cell.origin();
    diagram.radii = radii;
    diagram.counted = std::move(counted);
    diagram.particle.resize(diagram.counted.size());
    std::iota(diagram.particle.begin(), diagram.particle.end(), 0);
    find_edges(diagram);
    return diagram;
}

std::vector<char> inner_sites(const PowerDiagram& diagram) {
    const auto sites = static_cast<std::size_t>(diagram.positions.cols());
    std::vector<char> inner(sites, 0);
    if (diagram.edges.empty()) {
        return inner;
    }
    const ConvexHull hull(diagram);
    const double largest_radius = diagram.radii.maxCoeff();
    std::vector<std::array<char, 2>> inside(diagram.edges.size());
#pragma omp parallel for schedule(static)
    for (std::size_t edge = 0; edge < diagram.edges.size(); ++edge) {
        const EdgeGeometry geometry = measure_edge(diagram, diagram.edges[edge]);
        for (std::size_t which = 0; which < 2; ++which) {
            const bool contained = geometry.is_flat(which) ||
                                   hull.contains_ball(geometry.end[which], conflict_radius(geometry, which, largest_radius));
            inside[edge][which] = contained ? 1 : 0;
        }
    }
    for (const DiagramEdge& edge : diagram.edges) {  // swallowed sites have no cell and stay outside the count
        for (const int site : edge.around) {
            inner[static_cast<std::size_t>(site)] = 1;
        }
    }
    for (const auto& triangle : diagram.hull) {
        for (const int site : triangle) {
            inner[static_cast<std::size_t>(site)] = 0;
        }
    }
    for (std::size_t edge = 0; edge < diagram.edges.size(); ++edge) {
        for (std::size_t which = 0; which < 2; ++which) {
            if (inside[edge][which] == 0) {
                for (const int site : diagram.edges[edge].around) {
                    inner[static_cast<std::size_t>(site)] = 0;
                }
                inner[static_cast<std::size_t>(diagram.edges[edge].apex[which])] = 0;
            }
        }
    }
    return inner;
}

}  // namespace coagula::characterize
