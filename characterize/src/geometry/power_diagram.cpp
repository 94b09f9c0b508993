// SPDX-License-Identifier: GPL-3.0-or-later
#include "power_diagram.hpp"

#include "triangulation.hpp"

#include <coagula/common/checks.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace coagula::characterize {

namespace {

/// A triangle with less than this times (longest edge)^2 is taken for flat.
constexpr double flatness = 1e-11;

/// More sites than this do not fit into the memory of the machines this is made for.
constexpr double most_sites = 3e7;

/// Radius of the ball about a vertex which a site no larger than `largest_radius` must enter in order to change that vertex.
double conflict_radius(const DiagramVertex& vertex, double largest_radius) {
    return std::sqrt(std::max(0.0, vertex.power + largest_radius * largest_radius));
}

/// How far a place, seen from the corner of the box, lies outside it along its periodic edges; negative inside.
double beyond(const Cell& cell, const Eigen::Vector3d& place) {
    const Eigen::Vector3d fraction = cell.in_edges(place);
    double most = -std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double width = cell.widths()[axis];
        const double below = cell.is_rectangular() ? -place[axis] : -fraction[axis] * width;
        const double above = cell.is_rectangular() ? place[axis] - width : (fraction[axis] - 1) * width;
        most = cell.is_periodic(axis) ? std::max({most, below, above}) : most;
    }
    return most;
}

/// The particles themselves, in the box that begins at the origin.
PowerDiagram sites_in_the_box(const Packing& packing, const Eigen::VectorXd& radii, std::vector<char> counted) {
    PowerDiagram diagram;
    diagram.positions.resize(3, packing.size());
    for (Index i = 0; i < packing.size(); ++i) {
        diagram.positions.col(i) = packing.cell.wrap(packing.positions.col(i)) - packing.cell.origin();
    }
    diagram.radii = radii;
    diagram.counted = std::move(counted);
    diagram.counted.resize(static_cast<std::size_t>(packing.size()), 1);
    diagram.particle.resize(diagram.counted.size());
    std::iota(diagram.particle.begin(), diagram.particle.end(), 0);
    return diagram;
}

/// Adds the images of the particles that lie within `margin` of the box and are not there yet.
void widen(const Packing& packing, double margin, PowerDiagram& diagram) {
    const Cell& cell = packing.cell;
    const Index particles = packing.size();
    Eigen::Array3d layers = margin / cell.widths().array();
    for (int axis = 0; axis < 3; ++axis) {
        layers[axis] = cell.is_periodic(axis) ? layers[axis] : 0.0;
    }
    require(static_cast<double>(particles) * (1 + 2 * layers).prod() < most_sites,
            "the box is too elongated for its number of particles: their Voronoi cells reach through too many periodic images");
    std::vector<Eigen::Vector3d> images;
    for (Index i = 0; i < particles; ++i) {
        const Eigen::Vector3d place = diagram.positions.col(i);
        const Eigen::Array3d fraction = cell.in_edges(place);
        Eigen::Array3i first = (-layers - fraction).ceil().cast<int>();
        Eigen::Array3i last = (1 + layers - fraction).floor().cast<int>();
        for (int axis = 0; axis < 3; ++axis) {
            if (!cell.is_periodic(axis)) {
                first[axis] = last[axis] = 0;
            }
        }
        for (int x = first[0]; x <= last[0]; ++x) {
            for (int y = first[1]; y <= last[1]; ++y) {
                for (int z = first[2]; z <= last[2]; ++z) {
                    const Eigen::Vector3d image = place + cell.edges() * Eigen::Vector3d(x, y, z);
                    const double outside = beyond(cell, image);
                    const bool is_known = diagram.margin > 0 && outside <= diagram.margin;
                    if ((x != 0 || y != 0 || z != 0) && outside <= margin && !is_known) {
                        images.push_back(image);
                        diagram.particle.push_back(static_cast<int>(i));
                    }
                }
            }
        }
    }
    const Index known = diagram.positions.cols();
    const Index sites = known + std::ssize(images);
    diagram.positions.conservativeResize(Eigen::NoChange, sites);
    diagram.radii.conservativeResize(sites);
    for (Index site = known; site < sites; ++site) {
        diagram.positions.col(site) = images[static_cast<std::size_t>(site - known)];
        diagram.radii[site] = diagram.radii[diagram.particle[static_cast<std::size_t>(site)]];
    }
    diagram.counted.resize(static_cast<std::size_t>(sites), 0);
    diagram.margin = margin;
}

/// Whether a ball lies in the space that the particles enclose: the convex hull of the sites; between the outermost planes of a
/// packing with a single open edge, whose images go on along the others.
class Enclosure {
public:
    Enclosure(const Cell& cell, const PowerDiagram& diagram) {
        const std::optional<Eigen::Vector3d> normal = normal_of_slab(cell);
        const auto facets = static_cast<Index>(normal ? 2 : diagram.hull.size());
        normals_.resize(3, facets);
        offsets_.resize(facets);
        for (Index facet = 0; facet < facets; ++facet) {
            if (normal) {
                normals_.col(facet) = facet == 0 ? *normal : -*normal;
                offsets_[facet] = (normals_.col(facet).transpose() * diagram.positions).maxCoeff();
                continue;
            }
            const auto& corner = diagram.hull[static_cast<std::size_t>(facet)];
            const Eigen::Vector3d origin = diagram.positions.col(corner[0]);
            const Eigen::Vector3d first = diagram.positions.col(corner[1]) - origin;
            const Eigen::Vector3d second = diagram.positions.col(corner[2]) - origin;
            normals_.col(facet) = first.cross(second).stableNormalized();
            offsets_[facet] = normals_.col(facet).dot(origin);
        }
        centre_ = diagram.positions.rowwise().mean();
        inner_radius_ = facets > 0 ? (offsets_ - normals_.transpose() * centre_).minCoeff() : 0.0;
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

/// How wide the layer of images must be for all found vertices to be right; infinite if a counted cell of a periodic packing is
/// unbounded. Where there is a free surface, vertices that a particle beyond it could change do not ask for a layer.
double required_margin(const Cell& cell, const PowerDiagram& diagram) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto is_counted = [&](const auto& triangle) { return diagram.counts_any(triangle); };
    if (cell.is_periodic() && (diagram.vertices.empty() || std::any_of(diagram.hull.begin(), diagram.hull.end(), is_counted))) {
        return infinity;
    }
    std::optional<Enclosure> enclosure;
    if (!cell.is_periodic()) {
        enclosure.emplace(cell, diagram);
    }
    const double largest_radius = diagram.radii.maxCoeff();
    double margin = 0;
#pragma omp parallel for schedule(static) reduction(max : margin)
    for (const DiagramVertex& vertex : diagram.vertices) {
        const double radius = conflict_radius(vertex, largest_radius);
        if (vertex.relative_volume > 0 && (!enclosure || enclosure->contains_ball(vertex.place, radius))) {
            margin = std::max(margin, beyond(cell, vertex.place) + radius);
        }
    }
    return margin;
}

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
        const DiagramVertex& vertex = diagram.vertices[static_cast<std::size_t>(edge.end[which])];
        end = vertex.place;
        geometry.relative_volume[which] = triangle.is_flat() ? 0.0 : vertex.relative_volume;
        if (geometry.is_flat(which)) {
            geometry.height[which] = 0;
            continue;
        }
        const double above = triangle.normal.dot(end - diagram.positions.col(edge.around[0]));
        geometry.height[which] = which == 0 ? above : -above;
    }
    return geometry;
}

double largest_vertex_power(const PowerDiagram& diagram) {
    return largest_vertex(diagram).power;
}

DiagramVertex largest_vertex(const PowerDiagram& diagram) {
    DiagramVertex largest;
    largest.power = -std::numeric_limits<double>::infinity();
    for (const DiagramVertex& vertex : diagram.vertices) {
        const bool is_larger = vertex.power > largest.power || (vertex.power == largest.power && vertex.sites < largest.sites);
        if (is_larger && vertex.relative_volume > well_conditioned && diagram.counts_any(vertex.sites)) {
            largest = vertex;
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
        const int end = k + 1;
        const int site = sites[static_cast<std::size_t>(end)];
        const double other = diagram.radii[site] + growth;
        edges.row(k) = diagram.positions.col(site) - origin;
        half[k] = 0.5 * (edges.row(k).squaredNorm() + (radius - other) * (radius + other));
    }
    const Eigen::Vector3d vertex = edges.partialPivLu().solve(half);
    return vertex.allFinite() ? vertex.squaredNorm() - radius * radius : std::numeric_limits<double>::quiet_NaN();
}

std::optional<Eigen::Vector3d> normal_of_slab(const Cell& cell) {
    std::optional<Eigen::Vector3d> normal;
    for (int axis = 0; axis < 3; ++axis) {
        if (!cell.is_periodic(axis) && cell.is_periodic((axis + 1) % 3) && cell.is_periodic((axis + 2) % 3)) {
            normal = cell.edges().col((axis + 1) % 3).cross(cell.edges().col((axis + 2) % 3)).normalized();
        }
    }
    return normal;
}

namespace {

/// A layer of images to begin with.
double first_margin(const Packing& packing) {
    const auto particles = static_cast<double>(packing.size());
    // Somewhere along the longest side is a slab of thickness length / particles without a centre: some cells are that large.
    const double slab = packing.cell.edge_lengths().maxCoeff() / particles;
    return std::max(2.5 * std::cbrt(packing.cell.volume() / particles), 0.5 * slab);
}

}  // namespace

PowerDiagram power_diagram(const Packing& packing, const Eigen::VectorXd& radii, std::vector<char> counted, double margin) {
    PowerDiagram diagram = sites_in_the_box(packing, radii, std::move(counted));
    Triangulation triangulation(radii.minCoeff() == radii.maxCoeff());
    const bool has_images = !packing.cell.is_open();
    margin = margin > 0 ? margin : first_margin(packing);
    while (true) {
        if (has_images) {
            widen(packing, margin, diagram);
        }
        triangulation.insert(diagram);
        triangulation.find_vertices(diagram);
        const double required = has_images ? required_margin(packing.cell, diagram) : 0.0;
        if (required <= margin) {
            triangulation.find_edges(diagram);
            return diagram;
        }
        // While cells are still cut off by the rim, the requirement is far too high: approach it in steps.
        margin = std::min(1.001 * required, 1.5 * margin);
    }
}

std::vector<char> inner_sites(const Packing& packing, const PowerDiagram& diagram) {
    const auto sites = static_cast<std::size_t>(diagram.positions.cols());
    std::vector<char> inner(sites, 0);
    if (diagram.edges.empty()) {
        return inner;
    }
    const Enclosure enclosure(packing.cell, diagram);
    const double largest_radius = diagram.radii.maxCoeff();
    std::vector<char> is_certain(diagram.vertices.size());
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < diagram.vertices.size(); ++k) {
        const DiagramVertex& vertex = diagram.vertices[k];
        const bool is_flat = vertex.relative_volume == 0;
        is_certain[k] = is_flat || enclosure.contains_ball(vertex.place, conflict_radius(vertex, largest_radius)) ? 1 : 0;
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
    for (std::size_t k = 0; k < diagram.vertices.size(); ++k) {
        if (is_certain[k] == 0) {
            for (const int site : diagram.vertices[k].sites) {
                inner[static_cast<std::size_t>(site)] = 0;
            }
        }
    }
    std::fill(inner.begin() + packing.size(), inner.end(), char{0});  // an image is no particle of its own
    return inner;
}

}  // namespace coagula::characterize
