// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/forces.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

struct Entry {
    int first, second;
    double distance;
    bool operator<(const Entry& other) const {
        return std::tie(first, second, distance) < std::tie(other.first, other.second, other.distance);
    }
};

std::vector<Entry> listed(const ParticleSystem& system) {
    std::vector<Entry> entries;
    const Slots& slots = system.slots();
    for (const Chunk& chunk : system.chunks()) {
        for (const SlotPair& pair : chunk.pairs) {
            const auto first = static_cast<std::size_t>(pair.first);
            const auto second = static_cast<std::size_t>(pair.second);
            const Quad image = slots.position[static_cast<std::size_t>(slots.source[second])] + slots.shift[second];
            const auto ends = std::minmax(slots.particle[first], slots.particle[second]);
            entries.push_back({ends.first, ends.second, (image - slots.position[first]).head<3>().norm()});
        }
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

Eigen::Array<bool, 3, 1> periodic_edges(const Cell& cell) {
    return {cell.is_periodic(0), cell.is_periodic(1), cell.is_periodic(2)};
}

/// Every pair of images once, by trying all of them.
std::vector<Entry> all_pairs(const Packing& packing, double skin, int periods) {
    std::vector<Entry> entries;
    for (int i = 0; i < packing.size(); ++i) {
        for (int j = i; j < packing.size(); ++j) {
            for (int image = 0; image < (2 * periods + 1) * (2 * periods + 1) * (2 * periods + 1); ++image) {
                const int width = 2 * periods + 1;
                const Eigen::Vector3i place(image % width - periods, image / width % width - periods,
                                            image / width / width - periods);
                const Eigen::Vector3d shift = place.cast<double>();
                const bool exists = packing.cell.is_open() || ((shift.array() == 0) || periodic_edges(packing.cell)).all();
                const Eigen::Vector3d branch = packing.positions.col(j) - packing.positions.col(i) + packing.cell.edges() * shift;
                // Of a particle's two opposite images of itself one counts.
                const bool counted = i != j || image > width * width * width / 2;
                if (exists && counted && branch.norm() < packing.radii[i] + packing.radii[j] + skin) {
                    entries.push_back({i, j, branch.norm()});
                }
            }
        }
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

void expect_same(const std::vector<Entry>& found, const std::vector<Entry>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t entry = 0; entry < found.size(); ++entry) {
        EXPECT_EQ(found[entry].first, wanted[entry].first);
        EXPECT_EQ(found[entry].second, wanted[entry].second);
        EXPECT_NEAR(found[entry].distance, wanted[entry].distance, 1e-12);
    }
}

TEST(NeighbourList, FindsAllPairsOfUnequalSpheres) {
    const Packing packing = random_packing(Cell::periodic({20, 14, 9}), 400, 0.2, 1.5, 1);
    const ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.3);
    expect_same(listed(system), all_pairs(packing, 0.3, 1));
}

TEST(NeighbourList, FindsEveryPeriodicImageInABoxNarrowerThanTheReach) {
    const Packing packing = random_packing(Cell::periodic({3, 2.5, 6}), 7, 0.8, 1.6, 2);
    const ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.4);
    expect_same(listed(system), all_pairs(packing, 0.4, 3));
}

TEST(NeighbourList, FindsAllPairsInATiltedAndPartlyOpenBox) {
    const Eigen::Matrix3d edges = (Eigen::Matrix3d() << 20, 9, -4, 0, 14, 5, 0, 0, 9).finished();
    Packing packing = random_packing(Cell::periodic({1, 1, 1}), 300, 0.3, 1.5, 1);
    for (const std::array<bool, 3>& periodic : {std::array{true, true, true}, {true, false, true}, {false, false, true}}) {
        Packing tilted = packing;
        tilted.cell = Cell::of_edges(Eigen::Vector3d::Zero(), edges, periodic);
        for (auto position : tilted.positions.colwise()) {
            position = tilted.cell.place(position);
        }
        ParticleSystem system(tilted.cell, tilted.positions, tilted.radii, 0.3);
        expect_same(listed(system), all_pairs(tilted, 0.3, 2));
    }
}

TEST(NeighbourList, FindsPairsOfManySpheresInManyChunks) {
    const Packing packing = random_packing(Cell::periodic({24, 24, 24}), 2500, 0.9, 0.9, 3);
    const ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    ASSERT_GT(system.chunks().size(), 2U);
    expect_same(listed(system), all_pairs(packing, 0.2, 1));
}

TEST(NeighbourList, FindsPairsOutsideAnOpenCell) {
    Packing packing = random_packing(Cell::open({0, 0, 0}, {5, 5, 5}), 60, 0.5, 1.0, 4);
    packing.positions.col(0) << -8, 2, 2;
    packing.positions.col(1) << -7, 2, 2;
    packing.positions.col(2) << 11, 12, 9;
    const ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.3);
    expect_same(listed(system), all_pairs(packing, 0.3, 0));
}

TEST(NeighbourList, LeavesBondedPairsOutAndKeepsBondsThroughRebuilding) {
    const Packing packing = random_packing(Cell::periodic({12, 12, 12}), 200, 0.8, 1.0, 5);
    const ContactNetwork bonds = find_contacts(packing, 0.0);
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.3);
    system.add_bonds(bonds);
    EXPECT_EQ(listed(system).size() + static_cast<std::size_t>(bonds.size()), all_pairs(packing, 0.3, 1).size());
    // A drift through the boundary forces new lists; the bonds stay what they are.
    const Interactions<RepulsiveSpring, BondSpring> laws{RepulsiveSpring(1e-300), BondSpring(1e-300)};
    system.set_velocities(Eigen::Matrix3Xd::Constant(3, packing.size(), 1.0));
    for (int count = 0; count < 150; ++count) {
        step(system, laws, {.time_step = 0.1});
    }
    EXPECT_GT(system.list_builds(), 50);
    const ContactNetwork after = system.bond_network();
    ASSERT_EQ(after.size(), bonds.size());
    EXPECT_EQ(after.ends, bonds.ends);
    EXPECT_LT((after.branch - bonds.branch).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(NeighbourList, NeverMissesAContactWhileParticlesMoveAndGrow) {
    const Packing start = random_packing(Cell::periodic({14, 14, 14}), 600, 0.3, 0.9, 6);
    ParticleSystem system(start.cell, start.positions, start.radii, 0.25);
    system.set_velocities(0.5 * noise(start.size(), 7));
    const Interactions<RepulsiveSpring, BondSpring> laws{RepulsiveSpring(1.0), BondSpring(1.0)};
    Eigen::VectorXd radii = start.radii;
    for (int round = 0; round < 30; ++round) {
        radii *= 1.003;
        system.set_radii(radii);
        for (int count = 0; count < 7; ++count) {
            step(system, laws, {.time_step = 0.2, .damping = 0.1});
        }
        compute_forces(system, laws);
        ParticleSystem fresh(start.cell, system.positions(), radii, 0.25);
        compute_forces(fresh, laws);
        ASSERT_GT(fresh.forces().norm(), 0.1);
        EXPECT_LT((system.forces() - fresh.forces()).cwiseAbs().maxCoeff(), 1e-11);
    }
}

TEST(NeighbourList, FindsAllPairsOfUnequalSpheresThatReachTheNextBoxesOnly) {
    const Packing packing = random_packing(Cell::periodic({24, 20, 18}), 900, 0.7, 0.9, 9);
    const ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.5);
    expect_same(listed(system), all_pairs(packing, 0.5, 1));
}

TEST(NeighbourList, GivesTheSameForcesWithNearPairsToTheBit) {
    const Packing start = random_packing(Cell::periodic({14, 14, 14}), 900, 0.3, 0.8, 6);
    ParticleSystem all(start.cell, start.positions, start.radii, 0.6);
    all.set_velocities(0.5 * noise(start.size(), 7));
    ParticleSystem near = all;
    near.keep_near(0.1);
    const Interactions<RepulsiveSpring, BondSpring> repelling{RepulsiveSpring(1.0), BondSpring(1.0)};
    Interactions<RepulsiveSpring, BondSpring> sticking = repelling;
    sticking.bond_on_touch = true;
    Eigen::VectorXd radii = start.radii;
    for (int round = 0; round < 30; ++round) {
        radii.tail(300) *= 1.004;
        for (ParticleSystem* system : {&all, &near}) {
            system->set_radii(radii);
            system->shear(0, 2, 0.002);
            for (int count = 0; count < 7; ++count) {
                step(*system, count == 3 && round % 4 == 0 ? sticking : repelling, {.time_step = 0.2, .damping = 0.1});
            }
            system->remove_bonds([](const Bond& bond) { return bond.first % 3 == 0; });
        }
        ASSERT_EQ(near.forces(), all.forces()) << "round " << round;
        ASSERT_EQ(near.positions(), all.positions()) << "round " << round;
    }
    EXPECT_GT(near.list_builds(), 3);
    EXPECT_GT(near.bonds().size(), 50U);
}

TEST(NeighbourList, ReportsParticlesThatRunAway) {
    ParticleSystem system(Cell::periodic({10, 10, 10}), noise(4, 8), Eigen::VectorXd::Ones(4), 0.1);
    const Interactions<RepulsiveSpring, BondSpring> laws{RepulsiveSpring(1e9), BondSpring(1.0)};
    const auto run = [&] {
        for (int count = 0; count < 100; ++count) {
            step(system, laws, {.time_step = 100.0});
        }
    };
    EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace coagula::dem
