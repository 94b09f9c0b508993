// SPDX-License-Identifier: GPL-3.0-or-later
// Percolation of particles with many contacts: structures made by hand, crystals and flood fills.
#include <coagula/characterize/coordination_percolation.hpp>
#include <coagula/characterize/measure.hpp>

#include "named_results.hpp"
#include "networks.hpp"
#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace coagula::characterize {
namespace {

using test::scalar;

/// Spheres of radius 1 in a row around the box along x; on all but the last stands a smaller one, which touches nothing else.
Packing comb() {
    Packing packing;
    packing.cell = Cell::periodic({10, 20, 20});
    packing.radii = Eigen::VectorXd::Constant(9, 1);
    packing.radii.tail(4).setConstant(0.9);
    packing.positions.resize(3, 9);
    packing.positions << 1, 3, 5, 7, 9, 1, 3, 5, 7,  //
        1, 1, 1, 1, 1, 2.9, 2.9, 2.9, 2.9,           //
        1, 1, 1, 1, 1, 1, 1, 1, 1;
    return packing;
}

CoordinationPercolation with_at_least(int least, const Packing& packing) {
    return measure_coordination_percolation(packing, find_contacts(packing, 0.001), least);
}

TEST(CoordinationPercolation, OfAComb) {
    const Packing packing = comb();
    const CoordinationPercolation two = with_at_least(2, packing);
    EXPECT_TRUE(two.percolates(0));
    EXPECT_FALSE(two.percolates(1));
    EXPECT_EQ(two.windings(), 1);
    const CoordinationPercolation three = with_at_least(3, packing);  // the fifth of the row has two
    ASSERT_EQ(three.clusters.size(), 1U);
    EXPECT_EQ(three.clusters[0].particles, 4);
    EXPECT_FALSE(three.percolates(0));
    EXPECT_EQ(three.of_particle, (Eigen::VectorXi(9) << 0, 0, 0, 0, -1, -1, -1, -1, -1).finished());
    const CoordinationPercolation four = with_at_least(4, packing);
    EXPECT_TRUE(four.clusters.empty());
    EXPECT_EQ(four.windings(), 0);
}

/// Flood fill over the particles with so many contacts.
Index largest_by_flood(const ContactNetwork& contacts, int least) {
    const auto touch = test::touching(contacts);
    const auto enough = [&](Index i) { return touch.row(i).count() >= least; };
    std::set<Index> left;
    for (Index i = 0; i < contacts.particles; ++i) {
        if (enough(i)) {
            left.insert(i);
        }
    }
    Index largest = 0;
    while (!left.empty()) {
        std::vector<Index> cluster = {*left.begin()};
        left.erase(left.begin());
        for (std::size_t k = 0; k < cluster.size(); ++k) {
            std::erase_if(left, [&](Index other) {
                const bool joins = touch(cluster[k], other);
                if (joins) {
                    cluster.push_back(other);
                }
                return joins;
            });
        }
        largest = std::max(largest, std::ssize(cluster));
    }
    return largest;
}

TEST(CoordinationPercolation, LargestClusterIsThatOfAFloodFill) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Packing packing = test::random_open(150, seed);
        packing.radii.setConstant(0.09);
        const ContactNetwork contacts = find_contacts(packing, 0.01);
        for (const int least : {3, 6}) {
            const CoordinationPercolation found = measure_coordination_percolation(packing, contacts, least);
            ASSERT_FALSE(found.clusters.empty());
            EXPECT_EQ(found.clusters.front().particles, largest_by_flood(contacts, least)) << seed;
        }
    }
}

TEST(CoordinationPercolation, OfCrystals) {
    const std::string three = "coordination_percolation/three_or_more/", six = "coordination_percolation/six_or_more/";
    const MeasureResult cubic = run_measures(MeasureInput(test::simple_cubic({4, 4, 4}, 1)), {"coordination_percolation"});
    EXPECT_EQ(scalar(cubic, three + "fraction"), 1);
    EXPECT_EQ(scalar(cubic, six + "largest_fraction"), 1);
    // Rows of touching spheres that do not touch each other.
    Packing rows = test::simple_cubic({4, 4, 4}, 1);
    rows.radii.setConstant(0.9);
    rows.cell = Cell::periodic({7.2, 8, 8});
    rows.positions.row(0) *= 0.9;
    const MeasureResult found = run_measures(MeasureInput(rows), {"coordination_percolation"});
    EXPECT_EQ(scalar(found, three + "fraction"), 0);
    EXPECT_EQ(scalar(found, three + "largest_fraction"), 0);
}

}  // namespace
}  // namespace coagula::characterize
