// SPDX-License-Identifier: GPL-3.0-or-later
// The power diagram of spheres (the Voronoi diagram, if the radii are equal) as a list of its edges, from CGAL's triangulations.
// Internal; lengths are in any one unit.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace coagula::characterize {

/// An edge of the diagram. It is dual to a triangle of sites; its ends are dual to the two tetrahedra on that triangle.
struct DiagramEdge {
    std::array<int, 3> around;  ///< the sites whose cells share the edge
    std::array<int, 2> apex;    ///< fourth site of the tetrahedra, on the side of the normal (1-0) x (2-0) and on the other
    std::array<int, 2> end;     ///< its ends on these sides, as places in PowerDiagram::vertices
};

/// Least relative volume of a tetrahedron whose centre is well-conditioned. The largest of all spheres has its centre inside its
/// tetrahedron; if that one is flatter, a neighbour has the same sphere but for the square of the flatness.
inline constexpr double well_conditioned = 1e-6;

/// A vertex of the diagram: the point with the same power for four sites, dual to their tetrahedron.
struct DiagramVertex {
    std::array<int, 4> sites{};                       ///< ascending
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< undefined if flat
    double power = 0;                                 ///< with respect to the sites
    double relative_volume = 0;  ///< 6 x volume of the tetrahedron / longest edge^3; 0 if so flat that the vertex is undefined
};

struct PowerDiagram {
    Eigen::Matrix3Xd positions;            ///< of the sites: the particles in their order, then periodic images
    Eigen::VectorXd radii;                 ///< of the sites; power of a point = squared distance to the site - radius^2
    std::vector<int> particle;             ///< of the sites
    std::vector<char> counted;             ///< 1 for the sites whose cells are to be measured
    std::vector<DiagramVertex> vertices;   ///< of the counted cells
    std::vector<DiagramEdge> edges;        ///< bounded edges with a counted site among the three around
    std::vector<std::array<int, 3>> hull;  ///< triangles of the convex hull, normals outward
    double margin = 0;                     ///< width of the layer of periodic images

    /// Whether one of these sites is counted.
    template <std::size_t count>
    bool counts_any(const std::array<int, count>& sites) const {
        return std::any_of(sites.begin(), sites.end(), [this](int site) { return counted[static_cast<std::size_t>(site)] != 0; });
    }
};

/// The triangle between two sites around an edge and the foot of the edge, seen from either site.
struct EdgeSide {
    int first = 0, second = 0;   ///< positions in DiagramEdge::around
    double first_distance = 0;   ///< a: from the first site to the plane between the two (signed)
    double second_distance = 0;  ///< a: from the second site to it
    double foot_distance = 0;    ///< b: from the line of the sites to the line of the edge (signed)
};

/// Right tetrahedra around one edge: six sites' views times two ends.
struct EdgeGeometry {
    std::array<EdgeSide, 3> sides;
    std::array<double, 2> height{};      ///< c: from the plane of the three sites to the ends of the edge (signed); 0 if flat
    std::array<Eigen::Vector3d, 2> end;  ///< the ends (vertices of the diagram)
    std::array<double, 2>
        relative_volume{};  ///< 6 x volume of the tetrahedra / longest edge^3; 0 if so flat that its end is undefined
    double foot_power = 0;  ///< power of the point of the edge's line in the plane of the three sites

    /// A flat tetrahedron adds no volume, wherever its end is taken to be.
    bool is_flat(std::size_t which) const { return relative_volume[which] == 0; }
    /// Power of an end with respect to its four sites.
    double end_power(std::size_t which) const { return foot_power + height[which] * height[which]; }
};
EdgeGeometry measure_edge(const PowerDiagram& diagram, const DiagramEdge& edge);

/// Largest power of the vertices of the counted cells: in monodisperse packings, (distance to the nearest sites)^2 - radius^2.
double largest_vertex_power(const PowerDiagram& diagram);

/// The vertex of largest power of the counted cells.
DiagramVertex largest_vertex(const PowerDiagram& diagram);

/// Power of the point that has the same power for four sites, whether or not it is a vertex of the diagram, when all radii are
/// larger by `growth`; NaN if the sites lie in a plane.
double power_of_vertex(const PowerDiagram& diagram, const std::array<int, 4>& sites, double growth);

/// Diagram of the particles. Images are added in a layer around the box along its periodic edges, and the layer is widened until no
/// image beyond it could change a counted cell.
/// @param radii of the particles, in place of those in the packing.
/// @param counted 1 for the particles whose cells are to be measured; all of them if empty.
/// @param margin first guess of the width of the layer; <= 0 for a default.
PowerDiagram power_diagram(const Packing& packing, const Eigen::VectorXd& radii, std::vector<char> counted = {}, double margin = 0);

/// 1 for the sites whose cells no sphere beyond the free surface (the convex hull of the sites, or the outermost planes of a
/// packing that is periodic along two edges) could change, if it is no larger than the largest of the sites; 0 for images. The
/// diagram must count all particles.
std::vector<char> inner_sites(const Packing& packing, const PowerDiagram& diagram);

/// The unit normal of the faces of a box with a single open edge.
std::optional<Eigen::Vector3d> normal_of_slab(const Cell& cell);

/// On which side of a plane a height lies: 1 or -1, and 0 in it.
constexpr double sign(double height) {
    return height > 0 ? 1.0 : (height < 0 ? -1.0 : 0.0);
}

}  // namespace coagula::characterize
