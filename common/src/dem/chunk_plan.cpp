// SPDX-License-Identifier: GPL-3.0-or-later
#include "chunk_plan.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace coagula::dem {

std::uint64_t image_key(std::int32_t number, const Eigen::Vector3i& images) {
    auto key = static_cast<std::uint64_t>(number);
    for (const int periods : images) {
        const int shifted = periods + 512;
        key = (key << 10U) | static_cast<std::uint64_t>(shifted);
    }
    return key;
}

std::int32_t number_in(std::uint64_t image_key) {
    return static_cast<std::int32_t>(image_key >> 30U);
}

Eigen::Vector3i images_in(std::uint64_t image_key) {
    const auto periods = [&](unsigned place) { return static_cast<int>((image_key >> (10U * place)) & 1023U) - 512; };
    return {periods(2), periods(1), periods(0)};
}

void ChunkPlan::list_ghosts() {
    for (const auto* list : {&pairs, &bonds}) {
        for (const ListedPair& pair : *list) {
            if (!owns(pair)) {
                ghosts.push_back(image_key(pair.second, pair.images));
            }
        }
    }
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
}

SlotPair ChunkPlan::slots_of(const ListedPair& pair, std::int32_t begin) const {
    const std::int32_t slot = begin + (pair.first - first);
    if (owns(pair)) {
        return {slot, begin + (pair.second - first)};
    }
    const auto ghost = std::lower_bound(ghosts.begin(), ghosts.end(), image_key(pair.second, pair.images));
    return {slot, begin + (last - first) + static_cast<std::int32_t>(ghost - ghosts.begin())};
}

namespace {

/// About 512 particles each: they and their ghosts stay in a core's near caches, and there is work for many threads. Where threads
/// share them, a multiple of four, so that two or four have the same to do.
std::int32_t chunk_count(std::size_t particles) {
    const auto count = static_cast<std::int32_t>(std::clamp<std::size_t>(particles / 512, 1, 1024));
    return count < 6 ? count : (count + 3) / 4 * 4;
}

/// Bonded partners of each particle, both ways, so that the search can leave bonded pairs out.
class BondPartners {
public:
    BondPartners(const std::vector<Bond>& bonds, std::size_t particles, const std::vector<std::int32_t>& sorted_of)
        : start_(particles + 1, 0) {
        for (const Bond& bond : bonds) {
            ++start_[at(sorted_of[at(bond.first)]) + 1];
            ++start_[at(sorted_of[at(bond.second)]) + 1];
        }
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        partner_.resize(2 * bonds.size());
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (const Bond& bond : bonds) {
            const std::int32_t first = sorted_of[at(bond.first)];
            const std::int32_t second = sorted_of[at(bond.second)];
            partner_[next[at(first)]++] = image_key(second, bond.images);
            partner_[next[at(second)]++] = image_key(first, -bond.images);
        }
    }

    bool bonded(const ListedPair& pair) const {
        const auto begin = partner_.begin() + static_cast<std::ptrdiff_t>(start_[at(pair.first)]);
        const auto end = partner_.begin() + static_cast<std::ptrdiff_t>(start_[at(pair.first) + 1]);
        return begin != end && std::find(begin, end, image_key(pair.second, pair.images)) != end;
    }

private:
    std::vector<std::size_t> start_;
    std::vector<std::uint64_t> partner_;
};

std::vector<ChunkPlan> split(std::size_t particles) {
    const std::int32_t count = chunk_count(particles);
    std::vector<ChunkPlan> plans(at(count));
    for (std::int32_t chunk = 0; chunk < count; ++chunk) {
        const auto boundary = [&](std::int32_t c) { return static_cast<std::int32_t>(at(c) * particles / at(count)); };
        plans[at(chunk)].first = boundary(chunk);
        plans[at(chunk)].last = boundary(chunk + 1);
    }
    return plans;
}

void assign_bonds(std::vector<ChunkPlan>& plans, const std::vector<Bond>& bonds, const std::vector<std::int32_t>& sorted_of) {
    for (std::size_t number = 0; number < bonds.size(); ++number) {
        const Bond& bond = bonds[number];
        const std::int32_t first = sorted_of[at(bond.first)];
        const auto owner = std::upper_bound(plans.begin(), plans.end(), first,
                                            [](std::int32_t value, const ChunkPlan& plan) { return value < plan.last; });
        owner->bond_numbers.push_back(number);
    }
}

/// Bonds in the order of their particles: their loop then meets what it needs in the nearest cache.
void list_bonds(ChunkPlan& plan, const std::vector<Bond>& bonds, const std::vector<std::int32_t>& sorted_of) {
    const auto key = [&](std::size_t number) {
        return std::tuple(sorted_of[at(bonds[number].first)], sorted_of[at(bonds[number].second)], number);
    };
    std::sort(plan.bond_numbers.begin(), plan.bond_numbers.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    plan.bonds.reserve(plan.bond_numbers.size());
    for (const std::size_t number : plan.bond_numbers) {
        const Bond& bond = bonds[number];
        plan.bonds.push_back({sorted_of[at(bond.first)], sorted_of[at(bond.second)], bond.images});
    }
}

}  // namespace

std::vector<ChunkPlan> plan_chunks(const NeighbourSearch& search, const std::vector<Bond>& bonds) {
    const std::vector<std::int32_t>& order = search.order();
    std::vector<std::int32_t> sorted_of(order.size());
    for (std::size_t number = 0; number < order.size(); ++number) {
        sorted_of[at(order[number])] = static_cast<std::int32_t>(number);
    }
    const BondPartners partners(bonds, order.size(), sorted_of);
    std::vector<ChunkPlan> plans = split(order.size());
    assign_bonds(plans, bonds, sorted_of);
#pragma omp parallel for schedule(dynamic) if (plans.size() > 1)
    for (ChunkPlan& plan : plans) {
        std::vector<std::int32_t> scratch;
        for (std::int32_t number = plan.first; number < plan.last; ++number) {
            search.find_pairs_of(number, plan.pairs, scratch);
        }
        if (!bonds.empty()) {
            std::erase_if(plan.pairs, [&](const ListedPair& pair) { return partners.bonded(pair); });
        }
        list_bonds(plan, bonds, sorted_of);
        plan.list_ghosts();
    }
    return plans;
}

}  // namespace coagula::dem
