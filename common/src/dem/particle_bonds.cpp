// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>
#include <coagula/common/dem/particle_system.hpp>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "chunk_plan.hpp"

// Bonds and contacts of the particle system in the caller's particle numbers.

namespace coagula::dem {

void ParticleSystem::add_bonds(const ContactNetwork& pairs) {
    add_bonds(pairs, [](const Eigen::Vector3d& branch, double first_radius, double second_radius) {
        ContactMemory memory;
        memory.branch = branch;
        memory.rest_length = first_radius + second_radius;
        return memory;
    });
}

void ParticleSystem::add_bonds(const ContactNetwork& pairs,
                               const std::function<ContactMemory(const Eigen::Vector3d&, double, double)>& make) {
    require(pairs.particles == size(), "the bonds are those of " + std::to_string(pairs.particles) +
                                           " particles, but the particle system has " + std::to_string(size()));
    ParticleState state = this->state();
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        Bond bond;
        bond.first = pairs.ends(0, pair);
        bond.second = pairs.ends(1, pair);
        const Eigen::Vector3d direct = (state.position[at(bond.second)] - state.position[at(bond.first)]).head<3>();
        if (!cell_.is_open()) {
            const Eigen::Array3d periods = cell_.in_edges(shear_.undo(pairs.branch.col(pair) - direct));
            bond.images = periods.round().cast<int>();
        }
        bond.memory = make(direct + image_shift(bond.images), radii_[bond.first], radii_[bond.second]);
        state.bonds.push_back(bond);
    }
    rebuild(std::move(state));
}

std::vector<Bond> ParticleSystem::remove_bonds(const std::function<bool(const Bond&)>& breaks) {
    std::vector<Bond> removed;
    for (Chunk& chunk : chunks_) {
        std::size_t kept = 0;
        for (const SlotBond& simple : chunk.bonds) {
            const Bond bond = in_callers_numbers(simple);
            if (breaks(bond)) {
                removed.push_back(bond);
                chunk.pairs.push_back(simple.ends);
                chunk.near_stale = true;
            } else {
                chunk.bonds.set(kept++, simple);
            }
        }
        chunk.bonds.resize(kept);
    }
    return removed;
}

detail::BondExtremes ParticleSystem::largest_bond_loads() const {
    detail::BondExtremes largest;
    for (const Chunk& chunk : chunks_) {
        largest.stretch = std::max(largest.stretch, chunk.extremes.stretch);
        largest.shear_squared = std::max(largest.shear_squared, chunk.extremes.shear_squared);
    }
    return largest;
}

void ParticleSystem::use_general_contacts(bool general) {
    ParticleState state = this->state();
    general_ = general;
    rebuild(std::move(state));
}

Bond ParticleSystem::in_callers_numbers(const SlotPair& ends) const {
    const std::size_t second = at(ends.second);
    return {slots_.particle[at(ends.first)], slots_.particle[second], slots_.images[second], ContactMemory{}};
}

Bond ParticleSystem::in_callers_numbers(const SlotBond& simple) const {
    Bond bond = in_callers_numbers(simple.ends);
    bond.memory.rest_length = simple.rest_length;
    bond.memory.shear = simple.shear;
    bond.memory.branch = simple.branch;
    return bond;
}

std::vector<Bond> ParticleSystem::bonds() const {
    std::vector<Bond> bonds;
    for (const Chunk& chunk : chunks_) {
        for (const SlotBond& simple : chunk.bonds) {
            bonds.push_back(in_callers_numbers(simple));
        }
        for (const SlotContact& contact : chunk.contacts) {
            bonds.emplace_back(in_callers_numbers(contact.ends)).memory = contact.memory;
        }
    }
    return bonds;
}

ContactNetwork ParticleSystem::bond_network() const {
    struct Entry {
        std::int32_t first, second;
        Eigen::Vector3d branch;
    };
    std::vector<Entry> entries;
    for (const Bond& bond : bonds()) {
        if (!bond.memory.bonded) {
            continue;
        }
        const Quad& from = slots_.position[at(slot_of_[at(bond.first)])];
        const Quad& to = slots_.position[at(slot_of_[at(bond.second)])];
        const Eigen::Vector3d branch = (to - from).head<3>() + image_shift(bond.images);
        const bool swapped = bond.first > bond.second;
        entries.push_back(swapped ? Entry{bond.second, bond.first, -branch} : Entry{bond.first, bond.second, branch});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        const auto key = [](const Entry& e) { return std::make_tuple(e.first, e.second, e.branch[0], e.branch[1], e.branch[2]); };
        return key(a) < key(b);
    });
    ContactNetwork network;
    network.particles = size();
    network.ends.resize(2, static_cast<Index>(entries.size()));
    network.branch.resize(3, static_cast<Index>(entries.size()));
    for (std::size_t entry = 0; entry < entries.size(); ++entry) {
        network.ends.col(static_cast<Index>(entry)) << entries[entry].first, entries[entry].second;
        network.branch.col(static_cast<Index>(entry)) = entries[entry].branch;
    }
    return network;
}

}  // namespace coagula::dem
