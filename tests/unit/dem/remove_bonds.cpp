// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

const Interactions<RepulsiveSpring, BondedContact> laws{RepulsiveSpring(2.0), BondedContact(3.0, 0.7)};

constexpr Index particles = 1600;

/// Unequal spheres that hardly overlap, bonded over gaps and through the faces of the periodic cell.
Packing sparse_packing() {
    return random_packing(Cell::periodic({24, 25, 26}), particles, 0.4, 0.6, 41);
}

/// `pairs` of which `keep(number)` holds.
ContactNetwork part_of(const ContactNetwork& pairs, const std::function<bool(Index)>& keep) {
    std::vector<Index> kept;
    for (Index number = 0; number < pairs.size(); ++number) {
        if (keep(number)) {
            kept.push_back(number);
        }
    }
    ContactNetwork part;
    part.particles = pairs.particles;
    part.ends = pairs.ends(Eigen::all, kept);
    part.branch = pairs.branch(Eigen::all, kept);
    return part;
}

ParticleSystem moving_network(const ContactNetwork& bonds) {
    const Packing packing = sparse_packing();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(bonds);
    system.set_velocities(0.05 * noise(particles, 42));
    system.set_spins(0.05 * noise(particles, 43));
    return system;
}

/// Distance over the sum of the radii, for choosing bonds in either way of counting.
bool is_long(const Eigen::Vector3d& branch) {
    return branch.norm() > 1.2;
}

TEST(RemoveBonds, LeavesASystemThatNeverHadThem) {
    const Packing packing = sparse_packing();
    const ContactNetwork all = find_pairs(packing, 1.5);
    const ContactNetwork rest = part_of(all, [&](Index pair) { return !is_long(all.branch.col(pair)); });
    ASSERT_GT(rest.size(), 100);
    ASSERT_GT(all.size(), rest.size() + 100);
    ParticleSystem system = moving_network(all);
    ParticleSystem wanted = moving_network(rest);
    const auto removed = system.remove_bonds([](const Bond& bond) { return is_long(bond.memory.branch); });
    EXPECT_EQ(static_cast<Index>(removed.size()), all.size() - rest.size());
    const Index lists = system.list_builds();
    for (int count = 0; count < 100; ++count) {
        step(system, laws, {.time_step = 0.05, .damping = 0.2});
        step(wanted, laws, {.time_step = 0.05, .damping = 0.2});
    }
    EXPECT_GT(system.list_builds(), lists);
    EXPECT_EQ(system.bonds().size(), static_cast<std::size_t>(rest.size()));
    EXPECT_EQ(system.positions(), wanted.positions());
    EXPECT_EQ(system.spins(), wanted.spins());
    EXPECT_EQ(system.forces(), wanted.forces());
}

TEST(RemoveBonds, LeavesPairsThatRepelOnceTheyOverlap) {
    Packing packing{Cell::periodic({20, 20, 20}), Eigen::Matrix3Xd(3, 3), Eigen::Vector3d(1, 1, 1)};
    packing.positions << 19.5, 1.4, 3.5, 5, 5, 5, 5, 5,
        5;  // the first two overlap by 0.1 through the face, the others are 0.1 apart
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(find_pairs(packing, 2.2));
    compute_forces(system, laws);
    EXPECT_NEAR(system.forces()(0, 0), -3.0 * 0.1, 1e-14);
    EXPECT_NEAR(system.forces()(0, 2), -3.0 * 0.1, 1e-14);
    EXPECT_EQ(system.remove_bonds([](const Bond&) { return false; }).size(), 0U);
    EXPECT_EQ(system.remove_bonds([](const Bond&) { return true; }).size(), 2U);
    compute_forces(system, laws);
    EXPECT_NEAR(system.forces()(0, 0), -2.0 * 0.1, 1e-14);
    EXPECT_NEAR(system.forces()(0, 1), 2.0 * 0.1, 1e-14);
    EXPECT_EQ(system.forces()(0, 2), 0.0);
    EXPECT_EQ(system.largest_bond_loads().stretch, 0);
}

}  // namespace
}  // namespace coagula::dem
