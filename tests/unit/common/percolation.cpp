// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/percolation.hpp>

#include "networks.hpp"
#include "support/lattices.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace coagula {
namespace {

using coagula::testing::bonds_between;

/// Particles at given places of a periodic box, touching or not; bonds join successive ones.
struct Chain {
    Packing packing;
    std::vector<std::pair<int, int>> pairs;

    explicit Chain(const std::vector<Eigen::Vector3d>& places, double edge = 10) {
        packing.cell = Cell::periodic(Eigen::Vector3d::Constant(edge));
        packing.positions.resize(3, static_cast<Index>(places.size()));
        packing.radii = Eigen::VectorXd::Constant(packing.positions.cols(), 0.5);
        for (std::size_t i = 0; i < places.size(); ++i) {
            packing.positions.col(static_cast<Index>(i)) = packing.cell.wrap(places[i]);
            if (i > 0) {
                pairs.emplace_back(static_cast<int>(i) - 1, static_cast<int>(i));
            }
        }
    }
    void close() { pairs.emplace_back(static_cast<int>(packing.size()) - 1, 0); }
    std::vector<Cluster> clusters() const { return find_clusters(packing, bonds_between(packing, pairs)); }
};

std::vector<Eigen::Vector3d> row(int count, const Eigen::Vector3d& start, const Eigen::Vector3d& step) {
    std::vector<Eigen::Vector3d> places;
    for (int k = 0; k < count; ++k) {
        places.emplace_back(start + k * step);
    }
    return places;
}

void expect_percolates(const Cluster& cluster, bool x, bool y, bool z) {
    EXPECT_EQ(cluster.percolates(0), x);
    EXPECT_EQ(cluster.percolates(1), y);
    EXPECT_EQ(cluster.percolates(2), z);
}

TEST(Percolation, ChainAlongOneAxis) {
    Chain chain(row(10, {0.5, 3, 3}, {1, 0, 0}));
    expect_percolates(chain.clusters().front(), false, false, false);
    chain.close();
    const auto clusters = chain.clusters();
    ASSERT_EQ(clusters.size(), 1U);
    EXPECT_EQ(clusters[0].particles, 10);
    EXPECT_EQ(clusters[0].bonds, 10);
    EXPECT_EQ(clusters[0].windings.size(), 1U);
    expect_percolates(clusters[0], true, false, false);
}

// Nine tenths of the box, once inside it and once through its boundary: large, but not its own neighbour.
TEST(Percolation, ClusterLongerThanHalfOfTheBoxDoesNotSpan) {
    for (const double start : {0.5, 4.5}) {
        const auto clusters = Chain(row(9, {start, 3, 9.9}, {1, 0, 0})).clusters();
        ASSERT_EQ(clusters.size(), 1U);
        EXPECT_EQ(clusters[0].particles, 9);
        EXPECT_TRUE(clusters[0].windings.empty());
    }
}

// A ring that lies across a corner of the box has a loop, but comes back to where it began.
TEST(Percolation, RingAcrossTheCornerOfTheBox) {
    Chain ring({{9.5, 9.5, 0}, {10.5, 9.5, 0}, {10.5, 10.5, 0}, {9.5, 10.5, 0}});
    ring.close();
    const auto clusters = ring.clusters();
    EXPECT_EQ(clusters[0].bonds, 4);
    EXPECT_TRUE(clusters[0].windings.empty());
}

TEST(Percolation, DiagonalChainMeetsAnImageDisplacedAlongTwoAxes) {
    Chain chain(row(12, {0.1, 0.1, 5}, {10.0 / 12, 10.0 / 12, 0}));
    chain.close();
    const auto clusters = chain.clusters();
    ASSERT_EQ(clusters[0].windings.size(), 1U);
    EXPECT_EQ(clusters[0].windings[0].cwiseAbs(), Eigen::Vector3i(1, 1, 0));
    expect_percolates(clusters[0], true, true, false);
}

TEST(Percolation, SelectedBondsAndOrderBySize) {
    Chain chain(row(10, {0.5, 3, 3}, {1, 0, 0}));
    chain.close();
    const ContactNetwork bonds = bonds_between(chain.packing, chain.pairs);
    std::vector<bool> selected(10, true);
    selected[2] = selected[8] = false;  // 3..8 and 9, 0, 1, 2
    const auto parts = find_clusters(chain.packing, bonds, selected);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].particles, 6);
    EXPECT_EQ(parts[0].first, 3);
    EXPECT_EQ(parts[1].particles, 4);
    EXPECT_EQ(parts[1].bonds, 3);
    EXPECT_TRUE(parts[0].windings.empty() && parts[1].windings.empty());
    EXPECT_TRUE(find_clusters(chain.packing, bonds, std::vector<bool>(10, false)).empty());
    EXPECT_THROW(find_clusters(chain.packing, bonds, {true}), std::invalid_argument);
}

TEST(Percolation, CrystalsPercolateAlongAllAxesAlsoThroughTheirOwnImages) {
    using namespace coagula::testing;
    for (const int edge : {1, 2, 4}) {
        const Packing packing = make_lattice(simple_cubic(), edge, edge, edge);
        const auto clusters = find_clusters(packing, find_contacts(packing, 0.01));
        ASSERT_EQ(clusters.size(), 1U);
        EXPECT_EQ(clusters[0].particles, packing.size());
        EXPECT_EQ(clusters[0].windings.size(), 3U);
        expect_percolates(clusters[0], true, true, true);
    }
}

// A second way to know: in a box repeated three times along an axis, a cluster that does not wind along it comes three times, one
// that winds by one box comes once. The density is close to where percolation sets in.
TEST(Percolation, AgreesWithTheRepeatedBox) {
    constexpr int copies = 3;
    std::size_t spanning = 0;
    std::size_t finite = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Packing packing = coagula::testing::random_spheres(28, 7.0, 1.0, seed);
        const auto clusters = find_clusters(packing, find_contacts(packing, 0.0));
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d shift = packing.cell.lengths()[axis] * Eigen::Vector3d::Unit(axis);
            Packing repeated;
            repeated.cell = Cell::periodic(packing.cell.lengths() + (copies - 1) * shift);
            repeated.positions = packing.positions.replicate(1, copies);
            for (Index i = 0; i < repeated.positions.cols(); ++i) {
                const Index copy = i / packing.size();
                repeated.positions.col(i) += static_cast<double>(copy) * shift;
            }
            repeated.radii = Eigen::VectorXd::Constant(repeated.positions.cols(), 1.0);
            const auto winds = static_cast<std::size_t>(std::count_if(
                clusters.begin(), clusters.end(), [axis](const Cluster& cluster) { return cluster.percolates(axis); }));
            EXPECT_EQ(find_clusters(repeated, find_contacts(repeated, 0.0)).size(), copies * (clusters.size() - winds) + winds)
                << "seed " << seed << ", axis " << axis;
            spanning += winds;
            finite += clusters.size() - winds;
        }
    }
    EXPECT_GT(spanning, 3U);
    EXPECT_GT(finite, 3U);
}

}  // namespace
}  // namespace coagula
