// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_window.hpp"

#include <coagula/characterize/applicable.hpp>
#include <coagula/common/checks.hpp>

#include "geometry/power_diagram.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <set>

namespace coagula::characterize {

namespace {

std::vector<HalfSpace> half_spaces(const Packing& packing, const PowerDiagram& diagram) {
    std::vector<HalfSpace> planes;
    for (const auto& corner : diagram.hull) {
        const Eigen::Vector3d origin = packing.positions.col(corner[0]);
        const Eigen::Vector3d area = (packing.positions.col(corner[1]) - origin).cross(packing.positions.col(corner[2]) - origin);
        if (area.squaredNorm() > 0) {
            const Eigen::Vector3d normal = area.normalized();
            planes.push_back({normal, normal.dot(origin)});
        }
    }
    return planes;
}

double hull_volume(const Packing& packing, const PowerDiagram& diagram, const Eigen::Vector3d& centre) {
    double volume = 0;
    for (const auto& corner : diagram.hull) {
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k) {
            edges.col(k) = packing.positions.col(corner[static_cast<std::size_t>(k)]) - centre;
        }
        volume += edges.determinant() / 6;
    }
    return volume;
}

SampleWindow open_window(const Packing& packing) {
    const auto particles = static_cast<std::size_t>(packing.size());
    const std::string sentence = "the packing is open and has " + std::to_string(particles) + " particles";
    require(particles >= 5, sentence + ", but at least 5 are needed to know what space it fills");
    const Eigen::VectorXd equal = Eigen::VectorXd::Constant(packing.size(), mean_radius(packing));
    const Packing points{packing.cell, packing.positions, equal};
    const PowerDiagram diagram = power_diagram(points, equal);
    require(!diagram.hull.empty(), sentence + " in one plane: it fills no space");
    SampleWindow window;
    window.planes = half_spaces(packing, diagram);
    window.centre = packing.positions.rowwise().mean();
    window.ball_radius = window.depth_at(window.centre);
    window.volume = hull_volume(packing, diagram, window.centre);
    require(window.volume > 0 && window.ball_radius > 0, sentence + " in one plane: it fills no space");
    window.depth.resize(packing.size());
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < packing.size(); ++i) {
        window.depth[i] = std::max(0.0, window.depth_at(packing.positions.col(i)));
    }
    std::set<int> corners;
    for (const auto& corner : diagram.hull) {
        corners.insert(corner.begin(), corner.end());
    }
    window.density = static_cast<double>(particles - corners.size()) / window.volume;
    window.pair_density = window.density;
    require(window.density > 0, sentence + " which all lie at its surface");
    return window;
}

/// The space between the outermost centres of a packing that is periodic along the two edges across `normal`.
SampleWindow slab_window(const Packing& packing, const Eigen::Vector3d& normal) {
    const Eigen::VectorXd height = packing.positions.transpose() * normal;
    const double lower = height.minCoeff();
    const double upper = height.maxCoeff();
    const double thickness = upper - lower;
    const std::string sentence = "the packing is periodic along two edges and has " + std::to_string(packing.size()) + " particles";
    require(packing.size() >= 3 && thickness > 0, sentence + " in one plane: it fills no space");
    double width = 0;
    for (int axis = 0; axis < 3; ++axis) {
        width = packing.cell.is_periodic(axis) ? width : packing.cell.widths()[axis];
    }
    SampleWindow window;
    window.planes = {{normal, upper}, {-normal, -lower}};
    const Eigen::Vector3d centre = packing.cell.centre();
    window.centre = centre + (0.5 * (lower + upper) - centre.dot(normal)) * normal;
    window.ball_radius = std::min(thickness / 2, packing.cell.half_period());
    window.volume = packing.cell.volume() / width * thickness;
    window.depth = (height.array() - lower).min(upper - height.array());
    window.density = static_cast<double>(packing.size() - 2) / window.volume;
    window.pair_density = window.density;
    return window;
}

}  // namespace

double SampleWindow::depth_at(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfSpace& plane : planes) {
        least = std::min(least, plane.offset - plane.normal.dot(point));
    }
    return least;
}

SampleWindow sample_window(const Packing& packing) {
    if (const auto normal = normal_of_slab(packing.cell)) {
        return slab_window(packing, *normal);
    }
    if (!packing.cell.is_periodic()) {
        require_applicable(packing.cell.is_open(), "the box is periodic along one edge alone: it has no window for this measure");
        return open_window(packing);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double volume = packing.cell.volume();
    const auto particles = static_cast<double>(packing.size());
    return {Eigen::VectorXd::Constant(packing.size(), infinity),
            particles / volume,
            (particles - 1) / volume,
            volume,
            packing.cell.centre(),
            infinity};
}

}  // namespace coagula::characterize
