// SPDX-License-Identifier: GPL-3.0-or-later
// Space-filling designs have one point in each layer of each axis.
#include "design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace coagula::stages {
namespace {

/// Numbers of the layers that points have along an axis.
std::set<int> layers(const std::vector<std::vector<double>>& points, std::size_t axis, int count) {
    std::set<int> found;
    for (const std::vector<double>& point : points) {
        found.insert(static_cast<int>(point[axis] * count));
    }
    return found;
}

TEST(Design, LatinHypercubeHasOnePointInEachLayer) {
    const auto points = space_filling_points({Design::Kind::latin_hypercube, 17, 3}, 4);
    ASSERT_EQ(points.size(), 17U);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        EXPECT_EQ(layers(points, axis, 17).size(), 17U);
    }
    EXPECT_EQ(points, space_filling_points({Design::Kind::latin_hypercube, 17, 3}, 4));
    EXPECT_NE(points, space_filling_points({Design::Kind::latin_hypercube, 17, 4}, 4));
}

TEST(Design, SobolPointsFillEveryPairOfHalves) {
    const auto points = space_filling_points({Design::Kind::sobol, 64, 1}, 3);
    for (std::size_t one = 0; one < 3; ++one) {
        for (std::size_t other = 0; other < one; ++other) {
            std::array<int, 4> counts{};
            for (const auto& point : points) {
                ++counts[(point[one] < 0.5 ? 0 : 2) + (point[other] < 0.5 ? 0 : 1)];
            }
            EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 14);  // random points: 8 with a chance of 1 in 100
        }
    }
    for (const auto& point : points) {
        EXPECT_TRUE(std::all_of(point.begin(), point.end(), [](double value) { return value >= 0 && value < 1; }));
    }
}

TEST(Design, WithoutAnAxisThereAreSamples) {
    EXPECT_EQ(space_filling_points({Design::Kind::sobol, 5, 1}, 0).size(), 5U);
}

}  // namespace
}  // namespace coagula::stages
