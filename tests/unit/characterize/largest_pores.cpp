// SPDX-License-Identifier: GPL-3.0-or-later
// The largest pores: lattices with known holes; empty, touching and disjoint in random packings.
#include <coagula/characterize/largest_pores.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/checks.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

namespace coagula::characterize {

namespace {

using namespace test;

/// Gaps between a pore and all particles, ascending.
std::vector<double> gaps(const Packing& packing, const Eigen::Vector3d& centre, double radius) {
    std::vector<double> found;
    for (Index i = 0; i < packing.size(); ++i) {
        found.push_back(packing.cell.minimum_image(packing.positions.col(i) - centre).norm() - packing.radii[i] - radius);
    }
    std::sort(found.begin(), found.end());
    return found;
}

void expect_empty_and_touching(const Packing& packing, const LargestPores& pores) {
    for (Index k = 0; k < pores.size(); ++k) {
        const std::vector<double> gap = gaps(packing, pores.centres.col(k), pores.radii[k]);
        EXPECT_NEAR(gap[0], 0, 1e-8) << "pore " << k;
        EXPECT_NEAR(gap[3], 0, 1e-8) << "pore " << k << " touches fewer than four particles";
        for (Index other = 0; other < k; ++other) {
            const double distance = packing.cell.minimum_image(pores.centres.col(k) - pores.centres.col(other)).norm();
            EXPECT_GE(distance, (pores.radii[k] + pores.radii[other]) * (1 - 1e-8));
            EXPECT_LE(pores.radii[k], pores.radii[other]);
        }
    }
}

TEST(LargestPores, OfSimpleCubicAreItsCubes) {
    const Packing packing = simple_cubic({3, 3, 4}, 1);
    const LargestPores pores = find_largest_pores(packing, {.count = 1000});
    ASSERT_GE(pores.size(), 36);
    for (Index k = 0; k < 36; ++k) {
        EXPECT_NEAR(pores.radii[k], std::sqrt(3.0) - 1, 1e-12);
    }
    if (pores.size() > 36) {
        EXPECT_LT(pores.radii[36], std::sqrt(3.0) - 1 - 1e-3);
    }
}

TEST(LargestPores, OfFaceCentredAreItsOctahedra) {
    const Packing packing = face_centred({2, 2, 2}, 1);
    const LargestPores pores = find_largest_pores(packing, {.count = 32});  // one octahedron for each particle
    ASSERT_EQ(pores.size(), 32);
    EXPECT_NEAR(pores.radii.maxCoeff(), std::sqrt(2.0) - 1, 1e-12);
    EXPECT_NEAR(pores.radii.minCoeff(), std::sqrt(2.0) - 1, 1e-12);
}

TEST(LargestPores, FirstIsTheEndOfThePoreCurve) {
    const Packing packing = random_spheres(400, {10, 11, 12}, 0.4, 0.4, 5);
    const LargestPores pores = find_largest_pores(packing);
    ASSERT_EQ(pores.size(), 50);
    EXPECT_NEAR(pores.radii[0], measure_pores(packing).max, 1e-9);
    expect_empty_and_touching(packing, pores);
}

TEST(LargestPores, OfUnequalSpheresTouchFour) {
    const Packing packing = random_spheres(400, {10, 11, 12}, 0.1, 0.6, 6);
    const LargestPores pores = find_largest_pores(packing);
    ASSERT_EQ(pores.size(), 50);
    expect_empty_and_touching(packing, pores);
}

TEST(LargestPores, OfAnOpenPackingLieInside) {
    const Packing periodic = random_spheres(500, {10, 10, 10}, 0.4, 0.4, 7);
    const Packing open{Cell::open(periodic.cell.origin(), periodic.cell.lengths()), periodic.positions, periodic.radii};
    const LargestPores pores = find_largest_pores(open);
    ASSERT_GT(pores.size(), 0);
    expect_empty_and_touching(open, pores);
    for (Index k = 0; k < pores.size(); ++k) {
        EXPECT_GE(pores.centres.col(k).minCoeff() - pores.radii[k], 0);
        EXPECT_LE(pores.centres.col(k).maxCoeff() + pores.radii[k], 10);
    }
    EXPECT_LE(pores.radii[0], measure_pores(open).max * (1 + 1e-9));
}

TEST(LargestPores, NeedAPositiveNumber) {
    EXPECT_THROW(find_largest_pores(simple_cubic({2, 2, 2}, 1), {.count = 0}), std::invalid_argument);
}

}  // namespace

}  // namespace coagula::characterize
