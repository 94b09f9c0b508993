#include "ball_orthoscheme.hpp"
#include "coverage.hpp"

#include <vector>

namespace coagula::characterize {

namespace {

/// Covered and cell volume of the orthoschemes around one edge.
Eigen::Array2d cover_edge(const PowerDiagram& diagram, const DiagramEdge& edge) {
    const EdgeGeometry geometry = measure_edge(diagram, edge);
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    const auto add = [&](int corner, double a, double b) {
        const int site = edge.around[static_cast<std::size_t>(corner)];
        if (diagram.counted[static_cast<std::size_t>(site)] != 0) {
            for (const double c : geometry.height) {
                sum += Eigen::Array2d(volume_inside_ball(a, b, c, diagram.radii[site]), a * b * c / 6);
            }
        }
    };
    for (const EdgeSide& side : geometry.sides) {
        add(side.first, side.first_distance, side.foot_distance);
        add(side.second, side.second_distance, side.foot_distance);
    }
    return sum;
}

}  // namespace

std::array<double, 2> cover_spheres(const PowerDiagram& diagram) {
    constexpr std::size_t chunk = 4096;  // sums of sums: small rounding errors
    Eigen::Array2d total = Eigen::Array2d::Zero();
    for (std::size_t begin = 0; begin < diagram.edges.size(); begin += chunk) {
        Eigen::Array2d part = Eigen::Array2d::Zero();
        for (std::size_t edge = begin; edge < std::min(begin + chunk, diagram.edges.size()); ++edge) {
            part += cover_edge(diagram, diagram.edges[edge]);
        }
        total += part;
    }
    return {total[0], total[1]};
}

}  // namespace coagula::characterize
