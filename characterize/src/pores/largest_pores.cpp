// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/largest_pores.hpp>

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/common/checks.hpp>

#include "geometry/power_diagram.hpp"
#include "touching_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace coagula::characterize {

namespace {

/// Relative gap below which spheres touch rather than overlap.
constexpr double touching = 1e-9;

using Pore = Ball<3>;

std::optional<Pore> pore_between(const PowerDiagram& diagram, const std::array<int, 4>& sites) {
    Eigen::Matrix<double, 3, 4> centres;
    Eigen::Vector4d radii;
    for (int k = 0; k < 4; ++k) {
        centres.col(k) = diagram.positions.col(sites[static_cast<std::size_t>(k)]);
        radii[k] = diagram.radii[sites[static_cast<std::size_t>(k)]];
    }
    return touching_sphere<3>(centres, radii);
}

/// One candidate for every well-conditioned vertex of the diagram; each vertex is met several times.
std::vector<Pore> candidates(const Packing& packing, const PowerDiagram& diagram, const std::vector<bool>& inner) {
    const auto certain = [&](int site) {
        return inner[static_cast<std::size_t>(diagram.particle[static_cast<std::size_t>(site)])];
    };
    std::vector<Pore> found;
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        for (std::size_t which = 0; which < 2; ++which) {
            const std::array<int, 4> sites{edge.around[0], edge.around[1], edge.around[2], edge.apex[which]};
            if (geometry.relative_volume[which] > well_conditioned && std::all_of(sites.begin(), sites.end(), certain)) {
                if (const auto pore = pore_between(diagram, sites)) {
                    found.push_back({packing.cell.wrap(pore->centre + packing.cell.origin()), pore->radius});
                }
            }
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const Pore& one, const Pore& other) { return one.radius > other.radius; });
    return found;
}

bool overlaps(const Cell& cell, const Pore& pore, const Eigen::Vector3d& centre, double radius) {
    return cell.minimum_image(pore.centre - centre).norm() < (pore.radius + radius) * (1 - touching);
}

}  // namespace

LargestPores find_largest_pores(const Packing& packing, const LargestPoreOptions& options) {
    check(packing);
    require(options.count > 0, "the number of pores is " + std::to_string(options.count) + ", but must be positive");
    const std::vector<bool> inner = inner_particles(packing);
    const PowerDiagram diagram = power_diagram(packing, packing.radii, {inner.begin(), inner.end()});
    const bool equal = packing.radii.minCoeff() == packing.radii.maxCoeff();
    const auto enters_particle = [&](const Pore& pore) {
        for (Index i = 0; i < packing.size(); ++i) {
            if (overlaps(packing.cell, pore, packing.positions.col(i), packing.radii[i])) {
                return true;
            }
        }
        return false;
    };
    std::vector<Pore> taken;
    for (const Pore& pore : candidates(packing, diagram, inner)) {
        if (static_cast<Index>(taken.size()) == options.count) {
            break;
        }
        const bool is_new = std::none_of(taken.begin(), taken.end(), [&](const Pore& other) {
            return overlaps(packing.cell, pore, other.centre, other.radius);
        });
        if (is_new && (equal || !enters_particle(pore))) {
            taken.push_back(pore);
        }
    }
    LargestPores pores{Eigen::Matrix3Xd(3, static_cast<Index>(taken.size())), Eigen::VectorXd(static_cast<Index>(taken.size()))};
    for (std::size_t k = 0; k < taken.size(); ++k) {
        pores.centres.col(static_cast<Index>(k)) = taken[k].centre;
        pores.radii[static_cast<Index>(k)] = taken[k].radius;
    }
    return pores;
}

}  // namespace coagula::characterize
