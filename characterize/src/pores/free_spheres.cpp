// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/free_spheres.hpp>

#include "coverage_curve.hpp"
#include "pores_of_diagram.hpp"
#include "touching_sphere.hpp"
#include "void_graph.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace coagula::characterize {

namespace {

/// Radius of the sphere about a point of this power that touches spheres of the given radius.
double probe_radius(double power, double radius) {
    return power > 0 ? power / (std::sqrt(radius * radius + power) + radius) : 0.0;
}

FreeSpheres free_equal_spheres(const ReducedDiagram& reduced) {
    const double radius = reduced.packing.radii[0];
    const VoidGraph graph = void_graph(reduced.diagram, reduced.packing.cell);
    FreeSpheres found;
    const std::array<std::size_t, 3> closing = closing_links(graph);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        found.free_by_axis[static_cast<Index>(axis)] = 2 * probe_radius(graph.links[closing[axis]].power, radius);
    }
    found.free = found.free_by_axis.maxCoeff();
    if (found.free > 0) {
        constexpr double equal = 1e-9;  // links of a lattice differ by rounding
        const double threshold = graph.links[std::ranges::min(closing)].power;
        const std::vector<bool> reached = percolating_vertices(graph, threshold * (1 - equal));
        double largest = 0;
        for (std::size_t vertex = 0; vertex < reached.size(); ++vertex) {
            largest = reached[vertex] ? std::max(largest, graph.vertices[vertex].power) : largest;
        }
        found.included_along_free = 2 * probe_radius(largest, radius);
    }
    return found;
}

/// Radius of the smallest sphere that touches three spheres: its centre lies in their plane.
std::optional<double> closing_radius(const PowerDiagram& diagram, const Eigen::VectorXd& radii, const std::array<int, 3>& around) {
    const Eigen::Vector3d origin = diagram.positions.col(around[0]);
    const Eigen::Vector3d first = diagram.positions.col(around[1]) - origin;
    const Eigen::Vector3d second = diagram.positions.col(around[2]) - origin;
    const Eigen::Vector3d along = first.normalized();
    const Eigen::Vector3d across = (second - second.dot(along) * along).normalized();
    Eigen::Matrix<double, 2, 3> centres = Eigen::Matrix<double, 2, 3>::Zero();
    centres.col(1) << first.dot(along), 0;
    centres.col(2) << second.dot(along), second.dot(across);
    Eigen::Vector3d touched;
    for (int k = 0; k < 3; ++k) {
        touched[k] = radii[diagram.particle[static_cast<std::size_t>(around[static_cast<std::size_t>(k)])]];
    }
    const auto circle = touching_sphere<2>(centres, touched);
    return circle ? std::optional(circle->radius) : std::nullopt;
}

/// Diagrams of the packing with all radii larger by the radius of a probe.
class GrownDiagrams {
public:
    explicit GrownDiagrams(const ReducedDiagram& reduced) : reduced_(reduced), margin_(reduced.diagram.margin) {}

    PowerDiagram at(double growth) {
        PowerDiagram diagram = grown_diagram(reduced_.packing, reduced_.diagram, growth, margin_);
        margin_ = std::max(margin_, diagram.margin);
        return diagram;
    }

private:
    const ReducedDiagram& reduced_;
    double margin_;
};

/// Where the widest way along an axis closes as the radii grow. The diagram at one growth names the three spheres between which the
/// way is narrowest; where the gap between them closes is the next guess, and halving the interval where the guess leaves it.
double closing_growth(const ReducedDiagram& reduced, GrownDiagrams& diagrams, std::size_t axis, double largest) {
    constexpr double converged = 1e-10;
    constexpr int most_diagrams = 100;
    double open = 0;
    double closed = largest;
    double growth = 0;
    for (int k = 0; k < most_diagrams; ++k) {
        const PowerDiagram diagram = diagrams.at(growth);
        const VoidGraph graph = void_graph(diagram, reduced.packing.cell);
        const VoidGraph::Link& link = graph.links[closing_links(graph)[axis]];
        if (growth == 0 && link.power <= 0) {
            return 0;
        }
        (link.power > 0 ? open : closed) = growth;
        const auto guess = closing_radius(diagram, reduced.packing.radii, link.around);
        if ((guess && std::abs(*guess - growth) < converged) || closed - open < converged) {
            return growth;
        }
        growth = guess && *guess > open && *guess < closed ? *guess : 0.5 * (open + closed);
    }
    throw std::runtime_error("the largest free sphere could not be found");
}

/// Whether a probe can move straight from one point to another.
bool is_free(const Packing& packing, double probe, const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d middle = from + 0.5 * way;
        const Eigen::Vector3d centre = middle + packing.cell.minimum_image(packing.positions.col(i) - middle);
        const double part = std::clamp((centre - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        if ((from + part * way - centre).norm() < packing.radii[i] + probe) {
            return false;
        }
    }
    return true;
}

/// Whether the largest pore lies on the ways of the free sphere, if a straight way from a vertex on them shows that it does.
bool is_along(const ReducedDiagram& reduced, GrownDiagrams& diagrams, double free, double largest) {
    constexpr double aside = 1e-9;
    constexpr std::size_t most = 200;
    const Packing& packing = reduced.packing;
    const double probe = free * (1 - aside);
    const VoidGraph last = void_graph(diagrams.at(largest * (1 - aside)), packing.cell);
    const auto place = std::ranges::max_element(last.vertices, {}, &VoidGraph::Vertex::power);
    const VoidGraph graph = void_graph(diagrams.at(probe), packing.cell);
    const std::vector<bool> reached = percolating_vertices(graph, 0);
    std::vector<Eigen::Vector3d> ways;
    for (std::size_t vertex = 0; vertex < reached.size(); ++vertex) {
        if (reached[vertex] && graph.vertices[vertex].power > 0) {
            ways.push_back(packing.cell.minimum_image(graph.vertices[vertex].position - place->position));
        }
    }
    std::ranges::sort(ways, {}, [](const Eigen::Vector3d& way) { return way.squaredNorm(); });
    ways.resize(std::min(ways.size(), most));
    return std::ranges::any_of(ways, [&](const Eigen::Vector3d& way) { return is_free(packing, probe, place->position, way); });
}

FreeSpheres free_unequal_spheres(const ReducedDiagram& reduced, double largest, const Progress& progress) {
    FreeSpheres found;
    GrownDiagrams diagrams(reduced);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        progress.update("free spheres", static_cast<double>(axis) / 3);
        found.free_by_axis[static_cast<Index>(axis)] = 2 * closing_growth(reduced, diagrams, axis, largest);
    }
    found.free = found.free_by_axis.maxCoeff();
    if (found.free > 0 && is_along(reduced, diagrams, 0.5 * found.free, largest)) {
        found.included_along_free = 2 * largest;
    }
    return found;
}

}  // namespace

FreeSpheres measure_free_spheres(const ReducedDiagram& reduced, const Progress& progress) {
    require_inner(reduced);
    const double largest = largest_pore(reduced);
    FreeSpheres found;
    if (reduced.packing.cell.is_periodic()) {
        found = is_monodisperse(reduced.packing) ? free_equal_spheres(reduced) : free_unequal_spheres(reduced, largest, progress);
    }
    found.included = 2 * largest;
    found.included *= reduced.unit;
    found.free *= reduced.unit;
    found.included_along_free *= reduced.unit;
    found.free_by_axis *= reduced.unit;
    return found;
}

FreeSpheres measure_free_spheres(const Packing& packing, const Progress& progress) {
    check(packing);
    return measure_free_spheres(reduced_diagram(packing), progress);
}

}  // namespace coagula::characterize
