// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over neighbours: tables against the force they stand for, sums against pairs one by one, lanes against lanes.
#include <coagula/common/cell.hpp>
#include <coagula/common/random.hpp>

#include <gtest/gtest.h>

#include "pair_blocks.hpp"

#include <cmath>
#include <vector>

namespace coagula::generators {
namespace {

constexpr double kink = 0.006;
constexpr double end = 0.16;

/// Elastic below the kink, an attraction that diverges at contact above; ends smoothly.
double force(double gap) {
    const auto attraction = [](double h) { return -1e-2 / (h * h) * smooth_switch(h, 0.1, end); };
    return gap < kink ? attraction(kink) + 4e5 * (kink - gap) : attraction(gap);
}

ForceTable table() {
    return {force, -0.1, kink, end, 5e-4};
}

TEST(ForceTable, IsTheForce) {
    const ForceTable table = generators::table();
    for (double gap = -0.15; gap < 0.2; gap += 1.37e-5) {
        EXPECT_NEAR(table.force(gap), force(gap), 1e-4 * std::abs(force(gap)) + 1e-5) << gap;
    }
    // On both sides of the kink, where the slope jumps.
    EXPECT_NEAR((table.force(kink) - table.force(kink - 1e-7)) / 1e-7 / -4e5, 1, 1e-3);
    EXPECT_NEAR((table.force(kink + 1e-7) - table.force(kink)) / 1e-7 / (2e-2 / (kink * kink * kink)), 1, 2e-2);
    EXPECT_EQ(table.force(0.5), 0);
}

/// Rows of a random arrangement with many overlaps, through the faces of a small box.
struct Example {
    static constexpr std::size_t particles = 301;
    std::vector<double> positions = std::vector<double>(4 * particles);
    std::vector<double> radii = std::vector<double>(particles, 1.0);
    PairLoop loop{.period = {9, 10, 11}};
    NeighbourRows all;

    /// @param lean of the third edge of the box along x.
    explicit Example(bool equal, double lean = 0) {
        loop.lean = lean;
        all.clear(0, particles);
        for (std::size_t one = 0; one < particles; ++one) {
            const Eigen::Vector3d place = 30 * random_uniform(3, RandomPurpose::test, 0, one);  // not wrapped
            Eigen::Vector3d::Map(&positions[4 * one]) = place;
            radii[one] = equal ? 1.0 : 0.8 + 0.001 * static_cast<double>(one);
        }
        for (std::int32_t one = 0; one < static_cast<std::int32_t>(particles); ++one) {
            // Some rows are empty.
            for (std::int32_t other = 0; one % 7 != 3 && other < static_cast<std::int32_t>(particles); other += one % 5 + 1) {
                if (other != one) {
                    all.slots.push_back(other);
                }
            }
            all.close_row();
        }
        loop.positions = positions.data();
        loop.radii = equal ? nullptr : radii.data();
    }

    Eigen::Vector3d way(std::size_t from, std::size_t to) const {
        const auto place = [&](std::size_t slot) { return Eigen::Vector3d(Eigen::Vector3d::Map(&positions[4 * slot])); };
        Eigen::Matrix3d edges = Eigen::Vector3d::Map(loop.period.data()).asDiagonal();
        edges(0, 2) = loop.lean;
        return Cell::of_edges(Eigen::Vector3d::Zero(), edges, {true, true, true}).minimum_image(place(to) - place(from));
    }
};

/// Calls visit(slot, neighbour).
template <class Visit>
void for_each_neighbour(const NeighbourRows& rows, Visit&& visit) {
    for (std::size_t entry = 0; entry < rows.slots.size(); ++entry) {
        const std::int32_t owner = rows.owners[entry / NeighbourRows::width];
        if (rows.slots[entry] != owner) {
            visit(static_cast<std::size_t>(owner), static_cast<std::size_t>(rows.slots[entry]));
        }
    }
}

void expect_sums(bool equal, double lean = 0) {
    const Example example(equal, lean);
    const ForceTable table = generators::table();
    std::vector<double> sums(example.positions.size(), 7.0);
    sum_pair_forces(example.loop, table, example.all, sums.data());
    std::vector<double> expected(sums.size(), 0.0);
    double largest = 0;
    for_each_neighbour(example.all, [&](std::size_t one, std::size_t other) {
        const Eigen::Vector3d way = example.way(one, other);
        const double contact = example.radii[one] + example.radii[other];
        const double share = 2 * example.radii[one] * example.radii[other] / contact;
        const double strength = share * table.force(way.norm() - contact);
        largest = std::max(largest, std::abs(strength));
        Eigen::Vector3d::Map(&expected[4 * one]) -= strength * way.normalized();
    });
    for (std::size_t part = 0; part < sums.size(); ++part) {
        EXPECT_NEAR(sums[part], expected[part], 1e-9 * largest);
    }
}

TEST(BrownianKernels, SumForcesOfPairs) {
    expect_sums(true);
    expect_sums(false);
}

TEST(BrownianKernels, SumForcesInABoxThatLeans) {
    expect_sums(true, 2.7);
    expect_sums(false, -4.5);
}

TEST(BrownianKernels, ForcesDoNotChangeWhenTheBoxLeansByAWholeLength) {
    const Example one(true, 4.2);
    const Example flipped(true, 4.2 - one.loop.period[0]);
    std::vector<double> sums(one.positions.size());
    std::vector<double> others = sums;
    sum_pair_forces(one.loop, table(), one.all, sums.data());
    sum_pair_forces(flipped.loop, table(), flipped.all, others.data());
    double largest = 0;
    for (const double sum : sums) {
        largest = std::max(largest, std::abs(sum));
    }
    for (std::size_t part = 0; part < sums.size(); ++part) {
        EXPECT_NEAR(sums[part], others[part], 1e-9 * largest);
    }
}

template <class Lanes>
std::vector<double> summed(const Example& example) {
    std::vector<double> sums(example.positions.size());
    sum_rows<Lanes>(example.loop, table(), example.all,
                    [&sums](std::size_t slot, const Four& sum) { store(&sums[4 * slot], sum); });
    return sums;
}

TEST(BrownianKernels, GiveTheSameBitsOnEveryProcessor) {
    for (const bool equal : {true, false}) {
        const Example example(equal);
        std::vector<double> sums(example.positions.size());
        sum_pair_forces(example.loop, table(), example.all, sums.data());
        EXPECT_EQ(sums, summed<Four>(example));
        EXPECT_EQ(sums, summed<Eight>(example));
    }
}

TEST(BrownianKernels, ChooseTheNearNeighbours) {
    for (const bool equal : {true, false}) {
        const Example example(equal);
        NeighbourRows near;
        near.slots.assign(5, 1);  // to be forgotten
        choose_neighbours(example.loop, 0.4, example.all, near);
        std::vector<std::pair<std::size_t, std::size_t>> expected;
        for_each_neighbour(example.all, [&](std::size_t one, std::size_t other) {
            if (example.way(one, other).norm() < 0.4 + example.radii[one] + example.radii[other]) {
                expected.emplace_back(one, other);
            }
        });
        std::vector<std::pair<std::size_t, std::size_t>> found;
        for_each_neighbour(near, [&](std::size_t one, std::size_t other) { found.emplace_back(one, other); });
        EXPECT_EQ(found, expected);
        EXPECT_GT(found.size(), 100U);
        EXPECT_EQ(near.ends.size(), Example::particles);
    }
}

TEST(BrownianKernels, FindTheLongestWay) {
    const Example example(true);
    std::vector<double> moved = example.positions;
    for (const std::size_t slot : {0U, 150U, 300U}) {
        moved[4 * slot + 1] += 0.5 + 0.01 * static_cast<double>(slot);
        EXPECT_NEAR(longest_squared_way(moved.data(), example.positions.data(), 0, 0, Example::particles),
                    std::pow(0.5 + 0.01 * static_cast<double>(slot), 2), 1e-12);
    }
    EXPECT_EQ(longest_squared_way(moved.data(), example.positions.data(), 0, 1, 150), 0);
    // A particle that only follows the shear has not moved.
    for (std::size_t slot = 0; slot < Example::particles; ++slot) {
        moved[4 * slot] = example.positions[4 * slot] + 0.3 * example.positions[4 * slot + 2];
    }
    EXPECT_LT(longest_squared_way(moved.data(), example.positions.data(), 0.3, 1, 150), 1e-20);
    EXPECT_GT(longest_squared_way(moved.data(), example.positions.data(), 0, 1, 150), 1);
}

}  // namespace
}  // namespace coagula::generators
