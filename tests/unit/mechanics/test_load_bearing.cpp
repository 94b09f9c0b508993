// SPDX-License-Identifier: GPL-3.0-or-later
#include "networks.hpp"
#include "solvers/load_bearing.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

using coagula::testing::bonds_between;

/// Ten particles at irregular places; only the bonds matter.
Packing scattered() {
    return coagula::testing::random_spheres(10, 10.0, 1.0);
}

/// The complete graph of particles 0..4.
std::vector<std::pair<int, int>> core() {
    return {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
}

TEST(LoadBearing, RemovesDanglingChainsToTheirRoot) {
    auto pairs = core();
    pairs.insert(pairs.end(), {{4, 5}, {5, 6}, {6, 7}});
    const LoadBearing kept = find_load_bearing(bonds_between(scattered(), pairs));
    EXPECT_EQ(kept.particle, (std::vector<Index>{0, 1, 2, 3, 4}));
    EXPECT_EQ(kept.bond.size(), core().size());
    EXPECT_EQ(kept.number[5], -1);
    EXPECT_EQ(kept.number[3], 3);
}

TEST(LoadBearing, KeepsOneLinkBetweenTwoCorners) {
    auto pairs = core();
    pairs.insert(pairs.end(), {{0, 5}, {5, 1}});
    EXPECT_EQ(find_load_bearing(bonds_between(scattered(), pairs)).particle.size(), 6U);
}

TEST(LoadBearing, RemovesBentChainOfTwoLinksButKeepsAStraightOne) {
    auto pairs = core();
    pairs.insert(pairs.end(), {{0, 5}, {5, 6}, {6, 1}});
    Packing packing = scattered();
    EXPECT_EQ(find_load_bearing(bonds_between(packing, pairs)).particle.size(), 5U);

    const Eigen::Vector3d start = packing.positions.col(0);
    for (const auto& [particle, place] : {std::pair{5, 1.0}, {6, 2.0}, {1, 3.0}}) {
        packing.positions.col(particle) = packing.cell.wrap(start + place * Eigen::Vector3d(1, 0, 0));
    }
    EXPECT_EQ(find_load_bearing(bonds_between(packing, pairs)).particle.size(), 7U);
}

TEST(LoadBearing, WithMomentsOnlyDanglingEndsCarryNothing) {
    auto pairs = core();
    pairs.insert(pairs.end(), {{0, 5}, {5, 6}, {6, 1}, {4, 7}, {7, 8}});
    const LoadBearing kept = find_load_bearing(bonds_between(scattered(), pairs), {}, true);
    EXPECT_EQ(kept.particle, (std::vector<Index>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(kept.bond.size(), core().size() + 3);
}

TEST(LoadBearing, HeldParticlesAnchorWhatHangsOnThem) {
    const auto network = bonds_between(scattered(), {{0, 1}, {1, 2}});
    EXPECT_TRUE(find_load_bearing(network).particle.empty());
    std::vector<bool> held(10, false);
    held[0] = held[2] = true;
    const LoadBearing kept = find_load_bearing(network, held);
    EXPECT_EQ(kept.particle, (std::vector<Index>{1}));
    EXPECT_EQ(kept.bond.size(), 2U);
}

}  // namespace
}  // namespace coagula::mechanics
