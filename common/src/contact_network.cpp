// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/contact_network.hpp>

#include <coagula/common/cell_list.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/parallel.hpp>

#include <algorithm>

namespace coagula {

namespace {

struct Pair {
    int other;
    Eigen::Vector3d branch;
};

/// Whether a particle that meets its own image counts this one of the two opposite branches; false of itself.
bool points_up(const Cell& cell, const Eigen::Vector3d& branch) {
    const Eigen::Vector3d periods = cell.in_edges(branch).array().round();  // free of the rounding that a tilted box leaves
    return periods.z() != 0 ? periods.z() > 0 : (periods.y() != 0 ? periods.y() > 0 : periods.x() > 0);
}

/// Pairs with centre distance below reach(i, j); `cutoff` is the largest reach.
template <class Reach>
ContactNetwork collect_pairs(const Packing& packing, double cutoff, Reach&& reach) {
    const CellList cells(packing.cell, packing.positions, cutoff);
    const Index particles = packing.size();
    std::vector<std::vector<Pair>> rows(static_cast<std::size_t>(particles));
    constexpr Index block = 1024;
    const auto blocks = static_cast<std::size_t>((particles + block - 1) / block);
    run_together(blocks, [&](std::size_t number) {
        const Index begin = static_cast<Index>(number) * block;
        for (Index i = begin; i < std::min(begin + block, particles); ++i) {
            auto& row = rows[static_cast<std::size_t>(i)];
            cells.for_each_near(packing.positions.col(i), [&](int j, const Eigen::Vector3d& branch) {
                const double limit = reach(i, j);
                const bool counted = j > i || (j == i && points_up(packing.cell, branch));
                if (counted && branch.squaredNorm() < limit * limit) {
                    row.push_back({j, branch});
                }
            });
            std::stable_sort(row.begin(), row.end(), [](const Pair& a, const Pair& b) { return a.other < b.other; });
        }
    });
    Index count = 0;
    for (const auto& row : rows) {
        count += static_cast<Index>(row.size());
    }
    ContactNetwork network;
    network.particles = particles;
    network.ends.resize(2, count);
    network.branch.resize(3, count);
    Index pair = 0;
    for (Index i = 0; i < particles; ++i) {
        for (const Pair& entry : rows[static_cast<std::size_t>(i)]) {
            network.ends.col(pair) << static_cast<std::int32_t>(i), entry.other;
            network.branch.col(pair++) = entry.branch;
        }
    }
    return network;
}

}  // namespace

ContactNetwork find_contacts(const Packing& packing, double tolerance) {
    require(std::isfinite(tolerance) && tolerance > -1,
            "the contact tolerance is " + to_text(tolerance) + ", but must be finite and greater than -1");
    if (packing.size() == 0) {
        return {};
    }
    const double factor = 1 + tolerance;
    const auto reach = [&](Index i, Index j) { return factor * (packing.radii[i] + packing.radii[j]); };
    return collect_pairs(packing, 2 * factor * packing.radii.maxCoeff(), reach);
}

ContactNetwork find_pairs(const Packing& packing, double cutoff) {
    return collect_pairs(packing, cutoff, [cutoff](Index, Index) { return cutoff; });
}

Eigen::VectorXi contact_counts(const ContactNetwork& network) {
    Eigen::VectorXi counts = Eigen::VectorXi::Zero(network.particles);
    for (Index pair = 0; pair < network.size(); ++pair) {
        ++counts[network.ends(0, pair)];
        ++counts[network.ends(1, pair)];
    }
    return counts;
}

double coordination_number(const ContactNetwork& network) {
    return network.particles == 0 ? 0.0 : 2.0 * static_cast<double>(network.size()) / static_cast<double>(network.particles);
}

ContactsByParticle group_by_particle(const ContactNetwork& network) {
    ContactsByParticle groups;
    groups.start.assign(static_cast<std::size_t>(network.particles) + 1, 0);
    const Eigen::VectorXi counts = contact_counts(network);
    for (Index i = 0; i < network.particles; ++i) {
        groups.start[static_cast<std::size_t>(i) + 1] = groups.start[static_cast<std::size_t>(i)] + counts[i];
    }
    std::vector<Index> next(groups.start.begin(), groups.start.end() - 1);
    groups.contact.resize(static_cast<std::size_t>(2 * network.size()));
    for (Index pair = 0; pair < network.size(); ++pair) {
        for (int end = 0; end < 2; ++end) {
            const auto particle = static_cast<std::size_t>(network.ends(end, pair));
            groups.contact[static_cast<std::size_t>(next[particle]++)] = pair;
        }
    }
    return groups;
}

}  // namespace coagula
