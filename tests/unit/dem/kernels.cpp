// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/kernels.hpp>

#include <coagula/common/contact_memory.hpp>
#include <coagula/common/dem/general_forces.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

constexpr detail::SpringForce springs{3.0, 0.7};

/// A disordered network of unequal spheres, bonded also through the faces of the periodic cell, that has moved and turned, with
/// shear displacements from an earlier motion: ready for the next force evaluation.
ParticleSystem moved_network() {
    const Packing packing = random_packing(Cell::periodic({9, 10, 11}), 1100, 0.4, 1.0, 31);
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.5);
    system.add_bonds(find_contacts(packing, -0.4));
    for (const std::uint64_t round : {32U, 34U}) {
        system.set_velocities(0.03 * noise(1100, round));
        system.set_spins(0.03 * noise(1100, round + 1));
        step(system, sheared, {.time_step = 1.0});
    }
    for (Chunk& chunk : system.chunks()) {
        detail::prepare<true>(system.slots(), chunk);
    }
    return system;
}

/// Evaluates the bonds of all chunks.
std::vector<detail::BondExtremes> evaluate_bonds(ParticleSystem& system, const detail::Kernels& kernels) {
    std::vector<detail::BondExtremes> extremes;
    for (Chunk& chunk : system.chunks()) {
        extremes.push_back(
            kernels.add_spring_forces(detail::arrays_of(system.slots()), chunk.bonds.blocks(), chunk.bonds.size(), springs));
    }
    return extremes;
}

/// The same by the kinematics of the general contact law, one bond after the other.
void evaluate_by_general_kinematics(ParticleSystem& system) {
    for (Chunk& chunk : system.chunks()) {
        for (std::size_t number = 0; number < chunk.bonds.size(); ++number) {
            SlotBond bond = chunk.bonds[number];
            ContactMemory memory;
            memory.branch = bond.branch;
            memory.shear = bond.shear;
            const PairMotion motion = detail::motion_of(system.slots(), bond.ends);
            const ContactIncrement moved = advance(memory, motion);
            ContactForce force;
            force.force = sheared.bond.force((moved.distance - bond.rest_length) * moved.normal + memory.shear, moved.normal);
            detail::apply(system.slots(), bond.ends, motion, force);
            bond.branch = memory.branch;
            bond.shear = memory.shear;
            chunk.bonds.set(number, bond);
        }
    }
}

void expect_equal(const std::vector<Quad>& found, const std::vector<Quad>& wanted, double tolerance) {
    ASSERT_EQ(found.size(), wanted.size());
    double scale = 0, error = 0;
    for (std::size_t slot = 0; slot < found.size(); ++slot) {
        scale = std::max(scale, wanted[slot].norm());
        error = std::max(error, (found[slot] - wanted[slot]).norm());
    }
    ASSERT_GT(scale, 0.01);
    EXPECT_LE(error, tolerance * scale);
}

void expect_equal_bonds(const ParticleSystem& found, const ParticleSystem& wanted, double tolerance) {
    const std::vector<Bond> a = found.bonds(), b = wanted.bonds();
    ASSERT_EQ(a.size(), b.size());
    double scale = 0, error = 0;
    for (std::size_t number = 0; number < a.size(); ++number) {
        scale = std::max(scale, b[number].memory.shear.norm());
        error = std::max(error, (a[number].memory.shear - b[number].memory.shear).norm());
        EXPECT_EQ(a[number].memory.branch, b[number].memory.branch);
    }
    ASSERT_GT(scale, 0.01);
    EXPECT_LE(error, tolerance * scale);
}

TEST(Kernels, FollowTheKinematicsOfTheGeneralLaw) {
    ParticleSystem reference = moved_network();
    ASSERT_GT(reference.chunks().size(), 1U);
    evaluate_by_general_kinematics(reference);
    for (const detail::Kernels* kernels : {&detail::plain_kernels(), &detail::fastest_kernels()}) {
        ParticleSystem system = moved_network();
        evaluate_bonds(system, *kernels);
        expect_equal(system.slots().force, reference.slots().force, 1e-13);
        expect_equal(system.slots().moment, reference.slots().moment, 1e-13);
        expect_equal_bonds(system, reference, 1e-13);
    }
}

std::vector<std::int32_t> touching_pairs(const std::vector<Quad>& position, const std::vector<SlotPair>& pairs,
                                         const detail::Kernels& kernels) {
    std::vector<std::int32_t> found(pairs.size());
    found.resize(kernels.find_touching(position.data()->data(), &pairs.data()->first, pairs.size(), 0.0, found.data()));
    return found;
}

TEST(Kernels, FindThePairsThatOverlap) {
    const std::vector<Quad> position{{0, 0, 0, 1}, {1.5, 0, 0, 1}, {0, 2, 0, 1}, {0, 0, 2.1, 1}, {0, 1.2, 1.2, 0.75}, {9, 9, 9, 1}};
    // Spheres that just touch do not overlap. Seven pairs: one full register and three single ones.
    const std::vector<SlotPair> pairs{{0, 1}, {0, 2}, {0, 3}, {4, 0}, {3, 4}, {2, 4}, {5, 0}};
    const std::vector<std::int32_t> overlapping{0, 3, 4, 5};
    for (const detail::Kernels* kernels : {&detail::plain_kernels(), &detail::fastest_kernels()}) {
        EXPECT_EQ(touching_pairs(position, pairs, *kernels), overlapping);
    }
}

TEST(Kernels, FindThePairsWithinAGap) {
    const std::vector<Quad> position{{0, 0, 0, 1}, {2.1, 0, 0, 1}, {0, 2.3, 0, 1}, {0, 0, 1.9, 1}, {-2.19, 0, 0, 1}};
    const std::vector<SlotPair> pairs{{0, 1}, {0, 2}, {0, 3}, {4, 0}, {1, 2}};
    for (const detail::Kernels* kernels : {&detail::plain_kernels(), &detail::fastest_kernels()}) {
        std::vector<std::int32_t> found(pairs.size());
        found.resize(kernels->find_touching(position.data()->data(), &pairs.data()->first, pairs.size(), 0.2, found.data()));
        EXPECT_EQ(found, (std::vector<std::int32_t>{0, 2, 3}));
    }
}

TEST(Kernels, FindTheSpheresNearAPoint) {
    // The first and the last are out of the range that is searched.
    const std::vector<Quad> spheres{{0, 0, 0, 1},       {1.4, 0, 0, 1}, {1.6, 0, 0, 1}, {0, 1.2, 1.2, 1},
                                    {0, 1.2, 1.2, 1.3}, {-9, 0, 0, 1},  {-9, 0, 0, 9},  {0, 0, 0, 1}};
    const Quad centre(0, 0, 0, 0.5);
    for (const detail::Kernels* kernels : {&detail::plain_kernels(), &detail::fastest_kernels()}) {
        std::vector<std::int32_t> found(spheres.size());
        found.resize(kernels->find_near(spheres.data()->data(), 1, 7, centre.data(), found.data()));
        EXPECT_EQ(found, (std::vector<std::int32_t>{1, 4, 6}));
    }
}

TEST(Kernels, OfAllWidthsGiveTheSameBits) {
    ParticleSystem plain = moved_network();
    ParticleSystem fastest = plain;
    const auto plain_extremes = evaluate_bonds(plain, detail::plain_kernels());
    const auto fastest_extremes = evaluate_bonds(fastest, detail::fastest_kernels());
    EXPECT_EQ(plain.slots().force, fastest.slots().force);
    EXPECT_EQ(plain.slots().moment, fastest.slots().moment);
    expect_equal_bonds(fastest, plain, 0);
    for (std::size_t chunk = 0; chunk < plain_extremes.size(); ++chunk) {
        EXPECT_EQ(plain_extremes[chunk].stretch, fastest_extremes[chunk].stretch);
        EXPECT_EQ(plain_extremes[chunk].shear_squared, fastest_extremes[chunk].shear_squared);
    }
    const auto move = [](ParticleSystem& system, const detail::Kernels& kernels) {
        return kernels.move_particles(detail::motion_arrays_of(system.slots()), 3, 401, {0.1, 0.6, 0.9, true});
    };
    EXPECT_EQ(move(plain, detail::plain_kernels()), move(fastest, detail::fastest_kernels()));
    EXPECT_EQ(plain.slots().position, fastest.slots().position);
    EXPECT_EQ(plain.slots().velocity, fastest.slots().velocity);
    EXPECT_EQ(plain.slots().turn, fastest.slots().turn);
    EXPECT_EQ(plain.slots().spin, fastest.slots().spin);
}

TEST(Kernels, TellTheLargestLoadOfABond) {
    ParticleSystem system = moved_network();
    compute_forces(system, sheared);
    double stretch = 0, shear_squared = 0;
    for (const Bond& bond : system.bonds()) {
        stretch = std::max(stretch, bond.memory.branch.norm() - bond.memory.rest_length);
        shear_squared = std::max(shear_squared, bond.memory.shear.squaredNorm());
    }
    ASSERT_GT(stretch, 0);
    EXPECT_NEAR(system.largest_bond_loads().stretch, stretch, 1e-15);
    EXPECT_NEAR(system.largest_bond_loads().shear_squared, shear_squared, 1e-15);
    compute_forces(system, central);
    EXPECT_NEAR(system.largest_bond_loads().stretch, stretch, 1e-15);
    EXPECT_EQ(system.largest_bond_loads().shear_squared, 0);
}

}  // namespace
}  // namespace coagula::dem
