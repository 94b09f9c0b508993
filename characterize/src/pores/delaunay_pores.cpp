// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/delaunay_pores.hpp>

#include "pores_of_diagram.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace coagula::characterize {

namespace {

/// A radius and how much it counts.
struct Weighted {
    double radius;
    double weight;
};

double tetrahedron_volume(const PowerDiagram& diagram, const DiagramEdge& edge, std::size_t which) {
    const Eigen::Vector3d origin = diagram.positions.col(edge.around[0]);
    const Eigen::Vector3d first = diagram.positions.col(edge.around[1]) - origin;
    const Eigen::Vector3d second = diagram.positions.col(edge.around[2]) - origin;
    const Eigen::Vector3d third = diagram.positions.col(edge.apex[which]) - origin;
    return std::abs(first.cross(second).dot(third)) / 6;
}

/// Radius of the sphere about a point of this power that touches spheres of the given radius; negative if it lies inside them.
double pore_radius(double power, double radius) {
    return power / (std::sqrt(std::max(0.0, radius * radius + power)) + radius);
}

/// Whether the way along an edge is narrower at its foot than at its ends. A flat tetrahedron has its end at the foot.
bool has_throat(const EdgeGeometry& geometry) {
    constexpr double rounding = 1e-9;  // of the middle of an octahedron, which is foot and end of the edges there
    const auto beyond = [&](std::size_t which) { return geometry.height[which] > rounding; };
    return (beyond(0) || geometry.is_flat(0)) && (beyond(1) || geometry.is_flat(1)) && (beyond(0) || beyond(1));
}

class Sums {
public:
    explicit Sums(const ReducedDiagram& reduced)
        : reduced_(reduced), sums_(Eigen::Matrix<double, 7, Eigen::Dynamic>::Zero(7, reduced.packing.size())) {
        sums_.row(0).setOnes();
    }

    /// Every edge is met once for each counted site around it.
    void add(const DiagramEdge& edge) {
        const PowerDiagram& diagram = reduced_.diagram;
        const double sphere = diagram.radii[0];
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        const auto counted = static_cast<double>(std::ranges::count_if(edge.around, [&](int site) { return is_counted(site); }));
        for (std::size_t which = 0; which < 2; ++which) {
            if (!geometry.is_flat(which)) {
                const double share = tetrahedron_volume(diagram, edge, which) / 12;  // 4 particles, 3 triangles on each
                const double radius = pore_radius(geometry.end_power(which), sphere);
                add_to_particles(edge, 1, radius, share);
                circumspheres.push_back({radius, counted * share});
            }
        }
        if (has_throat(geometry)) {
            const double radius = pore_radius(geometry.foot_power, sphere);
            add_to_particles(edge, 4, radius, 1.0 / 3);
            throats.push_back({radius, counted / 3});
        }
    }

    /// The sums of each particle, lengths in metres.
    Eigen::Matrix<double, 7, Eigen::Dynamic> by_particle() const {
        const double unit = reduced_.unit;
        const double cubic = unit * unit * unit;
        Eigen::Matrix<double, 7, 1> units;
        units << 1, cubic, cubic * unit, cubic * unit * unit, 1, unit, unit * unit;
        return units.asDiagonal() * sums_;
    }

    std::vector<Weighted> circumspheres;
    std::vector<Weighted> throats;

private:
    bool is_counted(int site) const { return reduced_.diagram.counted[static_cast<std::size_t>(site)] != 0; }

    void add_to_particles(const DiagramEdge& edge, Index row, double radius, double weight) {
        for (const int site : edge.around) {
            if (is_counted(site)) {
                sums_.col(site).segment<3>(row) += weight * Eigen::Vector3d(1, radius, radius * radius);
            }
        }
    }

    const ReducedDiagram& reduced_;
    Eigen::Matrix<double, 7, Eigen::Dynamic> sums_;
};

/// Fraction of the weight beyond each radius.
Eigen::VectorXd fraction_beyond(const std::vector<Weighted>& values, const Eigen::VectorXd& radius) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(radius.size() + 1);
    for (const Weighted& value : values) {
        weight[std::lower_bound(radius.begin(), radius.end(), value.radius) - radius.begin()] += value.weight;
    }
    Eigen::VectorXd beyond(radius.size());
    double sum = 0;
    for (Index k = radius.size(); k-- > 0;) {
        sum += weight[k + 1];
        beyond[k] = sum;
    }
    return values.empty() ? beyond : Eigen::VectorXd(beyond / (sum + weight[0]));
}

}  // namespace

DelaunayPores measure_delaunay_pores(const ReducedDiagram& reduced, Index radii) {
    require(is_monodisperse(reduced.packing),
            "the spheres are unequal, and the sphere that touches four of them need not belong to a Delaunay tetrahedron");
    require_inner(reduced);
    Sums sums(reduced);
    for (const DiagramEdge& edge : reduced.diagram.edges) {
        sums.add(edge);
    }
    const double largest = std::ranges::max(sums.circumspheres, {}, &Weighted::radius).radius;
    const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(radii, 0, std::max(largest, 0.0));
    return {sums.by_particle(), reduced.unit * radius, fraction_beyond(sums.circumspheres, radius),
            fraction_beyond(sums.throats, radius)};
}

DelaunayPores measure_delaunay_pores(const Packing& packing, Index radii) {
    check(packing);
    return measure_delaunay_pores(reduced_diagram(packing), radii);
}

}  // namespace coagula::characterize
