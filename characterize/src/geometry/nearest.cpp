// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest.hpp"

#include <coagula/common/cell_list.hpp>

#include <algorithm>
#include <limits>

namespace coagula::characterize {

namespace {

/// The neighbours within the cut-off, nearest first; by number where distances are equal, so that the order is repeatable.
std::vector<Neighbour> neighbours_within(const Packing& packing, const CellList& cells, Index i, double cutoff) {
    std::vector<Neighbour> found;
    cells.for_each_near(packing.positions.col(i), [&](int j, const Eigen::Vector3d& separation) {
        const double squared_distance = separation.squaredNorm();
        if (squared_distance < cutoff * cutoff && (j != static_cast<int>(i) || squared_distance > 0)) {
            found.push_back({j, separation, squared_distance});
        }
    });
    std::sort(found.begin(), found.end(), [](const Neighbour& one, const Neighbour& other) {
        return one.squared_distance != other.squared_distance ? one.squared_distance < other.squared_distance
                                                              : one.particle < other.particle;
    });
    return found;
}

}  // namespace

std::vector<std::vector<Neighbour>> nearest_neighbours(const Packing& packing, Index count) {
    const auto particles = static_cast<std::size_t>(packing.size());
    const auto wanted = static_cast<std::size_t>(packing.cell.is_periodic() ? count : std::min(count, packing.size() - 1));
    std::vector<std::vector<Neighbour>> nearest(particles);
    std::vector<Index> pending;
    for (Index i = 0; i < packing.size(); ++i) {
        pending.push_back(i);
    }
    const double per_particle = packing.cell.volume() / static_cast<double>(particles);
    double cutoff = std::cbrt(0.35 * static_cast<double>(count) * per_particle);  // holds 1.5 times as many on average
    while (!pending.empty() && wanted > 0) {
        const CellList cells(packing.cell, packing.positions, cutoff);
        std::vector<char> done(pending.size(), 0);
#pragma omp parallel for schedule(dynamic, 64)
        for (std::size_t k = 0; k < pending.size(); ++k) {
            std::vector<Neighbour> found = neighbours_within(packing, cells, pending[k], cutoff);
            if (found.size() >= wanted) {
                found.resize(wanted);
                nearest[static_cast<std::size_t>(pending[k])] = std::move(found);
                done[k] = 1;
            }
        }
        std::size_t left = 0;
        for (std::size_t k = 0; k < pending.size(); ++k) {
            if (done[k] == 0) {
                pending[left++] = pending[k];
            }
        }
        pending.resize(left);
        cutoff *= 1.4;
    }
    return nearest;
}

}  // namespace coagula::characterize
