#include "sample_window.hpp"

#include <coagula/common/checks.hpp>

#include "power_diagram.hpp"

#include <Eigen/Geometry>

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
    const PowerDiagram diagram = open_diagram(points, equal, std::vector<char>(particles, 1));
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

}  // namespace

double SampleWindow::depth_at(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfSpace& plane : planes) {
        least = std::min(least, plane.offset - plane.normal.dot(point));
    }
    return least;
}

SampleWindow sample_window(const Packing& packing) {
    if (!packing.cell.is_periodic()) {
        return open_window(packing);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double volume = packing.cell.volume();
    const auto particles = static_cast<double>(packing.size());
    return {Eigen::VectorXd::Constant(packing.size(), infinity),
            particles / volume,
            (particles - 1) / volume,
            volume,
            packing.cell.origin() + packing.cell.lengths() / 2,
            infinity};
}

}  // namespace coagula::characterize
