// SPDX-License-Identifier: GPL-3.0-or-later
#include "coverage.hpp"
#include "geometry/ball_orthoscheme.hpp"

#include <vector>

namespace coagula::characterize {

namespace {

/// Adds covered and cell volume of the orthoschemes around one edge.
void cover_edge(const PowerDiagram& diagram, const DiagramEdge& edge, const Blocks& blocks, Eigen::Matrix2Xd& sums) {
    const EdgeGeometry geometry = measure_edge(diagram, edge);
    const auto add = [&](int corner, double a, double b) {
        const int site = edge.around[static_cast<std::size_t>(corner)];
        if (diagram.counted[static_cast<std::size_t>(site)] != 0) {
            for (const double c : geometry.height) {
                sums.col(blocks.of_particle[site]) +=
                    Eigen::Vector2d(volume_inside_ball(a, b, c, diagram.radii[site]), a * b * c / 6);
            }
        }
    };
    for (const EdgeSide& side : geometry.sides) {
        add(side.first, side.first_distance, side.foot_distance);
        add(side.second, side.second_distance, side.foot_distance);
    }
}

}  // namespace

Eigen::Matrix2Xd cover_spheres(const PowerDiagram& diagram, const Blocks& blocks) {
    constexpr std::size_t chunk = 4096;  // sums of sums: small rounding errors
    Eigen::Matrix2Xd total = Eigen::Matrix2Xd::Zero(2, blocks.count);
    for (std::size_t begin = 0; begin < diagram.edges.size(); begin += chunk) {
        Eigen::Matrix2Xd part = Eigen::Matrix2Xd::Zero(2, blocks.count);
        for (std::size_t edge = begin; edge < std::min(begin + chunk, diagram.edges.size()); ++edge) {
            cover_edge(diagram, diagram.edges[edge], blocks, part);
        }
        total += part;
    }
    return total;
}

}  // namespace coagula::characterize
