// SPDX-License-Identifier: GPL-3.0-or-later
// What a Brownian system does with contacts that resist sliding and rolling.
#include "brownian_system.hpp"

#include <algorithm>
#include <utility>

namespace coagula::generators {

/// Once each, in an order that does not depend on the number of threads.
template <class Call>
void BrownianSystem::for_each_contact(Call&& call) const {
    for (const Chunk& chunk : chunks_) {
        std::for_each(chunk.springs.inside.begin(), chunk.springs.inside.end(), call);
        for (const LoadedSpring& spring : chunk.springs.across) {
            // Two chunks share this contact.
            if (!spring.swapped) {
                call(spring);
            }
        }
    }
}

std::vector<ContactSpring> BrownianSystem::springs() const {
    std::vector<ContactSpring> springs;
    for_each_contact([&](const LoadedSpring& spring) {
        springs.push_back({particle_[spring.low()], particle_[spring.high()], spring.sliding, spring.rolling});
    });
    std::sort(springs.begin(), springs.end(), [](const ContactSpring& a, const ContactSpring& b) {
        return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    return springs;
}

SpringEnergy BrownianSystem::observed_energy() const {
    SpringEnergy sum;
    if (!setup_.springs.active()) {
        return sum;
    }
    const std::vector<double> moved = translation_.observed(setup_, step_, RandomPurpose::brownian_observation, particle_);
    const std::vector<double> turned = rotation_.observed(setup_, step_, RandomPurpose::rotation_observation, particle_);
    SpringLoop loop = spring_loop(0);
    loop.moved = moved.data();
    loop.turned = turned.data();
    for_each_contact([&](const LoadedSpring& spring) {
        const SpringEnergy one = energy_of(loop, spring);
        sum.sliding += one.sliding;
        sum.rolling += one.rolling;
    });
    return sum;
}

/// @param moved observed positions.
Eigen::Matrix3d BrownianSystem::observed_sliding_virial(const std::vector<double>& moved) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    if (!setup_.springs.active()) {
        return sum;
    }
    const std::vector<double> turned = rotation_.observed(setup_, step_, RandomPurpose::rotation_observation, particle_);
    SpringLoop loop = spring_loop(0);
    loop.moved = moved.data();
    loop.turned = turned.data();
    for_each_contact([&](const LoadedSpring& spring) { sum += virial_of(loop, spring); });
    return sum;
}

/// Gives the springs to the chunks that share them, in the order of the pairs.
void BrownianSystem::place_springs(const std::vector<ContactSpring>& springs) {
    if (!setup_.springs.active()) {
        return;
    }
    std::vector<std::int32_t> slot_of(particle_.size());
    for (std::size_t slot = 0; slot < particle_.size(); ++slot) {
        slot_of[static_cast<std::size_t>(particle_[slot])] = static_cast<std::int32_t>(slot);
    }
    const SpringLoop loop = spring_loop(0);
    for (Chunk& chunk : chunks_) {
        chunk.springs.inside.clear();
        chunk.springs.across.clear();
        const auto holds = [&](std::int32_t slot) {
            return static_cast<std::size_t>(slot) >= chunk.begin && static_cast<std::size_t>(slot) < chunk.end;
        };
        for (const ContactSpring& spring : springs) {
            const std::int32_t low = slot_of[static_cast<std::size_t>(spring.first)];
            const std::int32_t high = slot_of[static_cast<std::size_t>(spring.second)];
            if (holds(low) && holds(high)) {
                chunk.springs.inside.push_back(loaded(loop, low < high ? SlotPair{low, high} : SlotPair{high, low}, spring));
            } else if (holds(low)) {
                chunk.springs.across.push_back(loaded(loop, {low, high}, spring));
            } else if (holds(high)) {
                chunk.springs.across.push_back(loaded(loop, {high, low}, spring));
            }
        }
        for (auto* list : {&chunk.springs.inside, &chunk.springs.across}) {
            std::sort(list->begin(), list->end(), [](const LoadedSpring& a, const LoadedSpring& b) {
                return std::pair(a.ends.first, a.ends.second) < std::pair(b.ends.first, b.ends.second);
            });
        }
    }
}

/// The near neighbours as pairs, in the order of their first slots.
void BrownianSystem::pair_up(Chunk& chunk) const {
    chunk.near_pairs.inside.clear();
    chunk.near_pairs.across.clear();
    for (std::size_t entry = 0; entry < chunk.near.slots.size(); ++entry) {
        const std::int32_t first = chunk.near.owners[entry / NeighbourRows::width];
        const std::int32_t second = chunk.near.slots[entry];
        const auto other = static_cast<std::size_t>(second);
        if (other < chunk.begin || other >= chunk.end) {
            chunk.near_pairs.across.push_back({first, second});
        } else if (second > first) {
            chunk.near_pairs.inside.push_back({first, second});
        }
    }
}

SpringLoop BrownianSystem::spring_loop(std::size_t stage) const {
    SpringLoop loop{.rules = &setup_.springs,
                    .period = {setup_.period[0], setup_.period[1], setup_.period[2]},
                    .lean = lean(),
                    .moved_lean = lean_of_stage(stage),
                    .particles = particle_.data(),
                    .radii = radius_.data(),
                    .position = translation_.start.data(),
                    .moved = translation_.stages[stage % 2].data(),
                    .rotation = rotation_.start.data(),
                    .turned = rotation_.stages[stage % 2].data()};
    return loop;
}

void BrownianSystem::advance_contacts(Chunk& chunk) const {
    const SpringLoop loop = spring_loop(setup_.scheme.stages.size());
    advance_springs(loop, chunk.springs.inside);
    advance_springs(loop, chunk.springs.across);
}

}  // namespace coagula::generators
