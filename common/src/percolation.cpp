// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/percolation.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/image_sets.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

namespace coagula {

namespace {

using Image = Eigen::Vector3i;

/// Boxes between the second particle of a bond as the branch vector reaches it and as its coordinates say.
Image crossed_boxes(const Packing& packing, const ContactNetwork& bonds, Index bond) {
    const Eigen::Vector3d direct = packing.positions.col(bonds.ends(1, bond)) - packing.positions.col(bonds.ends(0, bond));
    Eigen::Vector3d boxes = packing.cell.in_edges(bonds.branch.col(bond) - direct);
    for (int axis = 0; axis < 3; ++axis) {
        boxes[axis] = packing.cell.is_periodic(axis) ? std::round(boxes[axis]) : 0.0;
    }
    return boxes.cast<int>();
}

/// Whether `winding` is linearly independent of the (fewer than four, independent) others.
bool is_independent(const std::vector<Image>& others, const Image& winding) {
    using Exact = Eigen::Matrix<std::int64_t, 3, 1>;
    const Exact w = winding.cast<std::int64_t>();
    switch (others.size()) {
        case 0:
            return !w.isZero();
        case 1:
            return !w.cross(others[0].cast<std::int64_t>()).isZero();
        case 2:
            return w.dot(others[0].cast<std::int64_t>().cross(others[1].cast<std::int64_t>())) != 0;
        default:
            return false;
    }
}

struct Loop {
    std::size_t particle;
    Image winding;
};

/// Joins the ends of the bonds; returns the loops that reach around the box.
std::vector<Loop> join_bonds(const Packing& packing, const ContactNetwork& bonds, const std::vector<bool>& selected,
                             ImageSets& sets) {
    std::vector<Loop> loops;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        if (selected.empty() || selected[static_cast<std::size_t>(bond)]) {
            const auto first = static_cast<std::size_t>(bonds.ends(0, bond));
            const Image winding =
                sets.join(first, static_cast<std::size_t>(bonds.ends(1, bond)), crossed_boxes(packing, bonds, bond));
            if (!winding.isZero()) {
                loops.push_back({first, winding});
            }
        }
    }
    return loops;
}

}  // namespace

bool Cluster::percolates(int axis) const {
    return std::any_of(windings.begin(), windings.end(), [axis](const Eigen::Vector3i& winding) { return winding[axis] != 0; });
}

std::vector<Cluster> find_clusters(const Packing& packing, const ContactNetwork& bonds, const std::vector<bool>& selected) {
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require(selected.empty() || selected.size() == static_cast<std::size_t>(bonds.size()),
            "the flags of the selected bonds must be one per bond");
    ImageSets sets(packing.size());
    const std::vector<Loop> loops = join_bonds(packing, bonds, selected, sets);
    std::vector<Cluster> by_root(static_cast<std::size_t>(packing.size()));
    for (Index particle = packing.size(); particle-- > 0;) {
        Cluster& cluster = by_root[sets.find(static_cast<std::size_t>(particle)).root];
        cluster.first = particle;
        ++cluster.particles;
    }
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        if (selected.empty() || selected[static_cast<std::size_t>(bond)]) {
            ++by_root[sets.find(static_cast<std::size_t>(bonds.ends(0, bond))).root].bonds;
        }
    }
    for (const Loop& loop : loops) {
        std::vector<Image>& windings = by_root[sets.find(loop.particle).root].windings;
        if (is_independent(windings, loop.winding)) {
            windings.push_back(loop.winding);
        }
    }
    std::erase_if(by_root, [](const Cluster& cluster) { return cluster.bonds == 0; });
    std::sort(by_root.begin(), by_root.end(), [](const Cluster& a, const Cluster& b) {
        return a.particles != b.particles ? a.particles > b.particles : a.first < b.first;
    });
    return by_root;
}

Eigen::VectorXi cluster_of_particles(const ContactNetwork& bonds, const std::vector<Cluster>& clusters,
                                     const std::vector<bool>& selected) {
    ImageSets sets(bonds.particles);
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        if (selected.empty() || selected[static_cast<std::size_t>(bond)]) {
            sets.join(static_cast<std::size_t>(bonds.ends(0, bond)), static_cast<std::size_t>(bonds.ends(1, bond)), Image::Zero());
        }
    }
    std::vector<int> of_root(static_cast<std::size_t>(bonds.particles), -1);
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        of_root[sets.find(static_cast<std::size_t>(clusters[k].first)).root] = static_cast<int>(k);
    }
    Eigen::VectorXi result(bonds.particles);
    for (Index particle = 0; particle < bonds.particles; ++particle) {
        result[particle] = of_root[sets.find(static_cast<std::size_t>(particle)).root];
    }
    return result;
}

}  // namespace coagula
