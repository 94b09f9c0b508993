// SPDX-License-Identifier: GPL-3.0-or-later
// The exact pore curve against random points, within the binomial error of these.
#include "unit/characterize/test_packings.hpp"

#include <coagula/characterize/pore_sizes.hpp>

#include <gtest/gtest.h>

namespace coagula::characterize {
namespace {

void expect_agreement(const Packing& packing) {
    const PoreSizes exact = measure_pores(packing, {.radii = 13});
    const SampledPores sampled = sample_pores(packing, exact.radius, 400000, 7);
    const auto points = static_cast<double>(sampled.void_points);
    EXPECT_NEAR(points / 400000, exact.void_fraction, 4.5 * std::sqrt(exact.void_fraction * (1 - exact.void_fraction) / 400000));
    EXPECT_EQ(exact.exclusion_probability[0], 1);
    EXPECT_EQ(sampled.exclusion_probability[0], 1);
    EXPECT_EQ(sampled.exclusion_probability[12], 0);
    for (Index k = 1; k < 12; ++k) {
        const double p = exact.exclusion_probability[k];
        const double error = std::sqrt(p * (1 - p) / points) + 1 / points;
        EXPECT_LT(std::abs(sampled.exclusion_probability[k] - p), 4.5 * error) << "at radius " << k << ", P = " << p;
    }
}

TEST(SampledAgainstExact, VoidExpansionStructure) {
    expect_agreement(test::reference_structure("vem_1-8"));
}

TEST(SampledAgainstExact, OverlappingEqualSpheresInAnElongatedBox) {
    expect_agreement(test::random_spheres(300, {4, 9, 17}, 0.6, 0.6, 1));
}

TEST(SampledAgainstExact, UnequalSpheres) {
    expect_agreement(test::random_spheres(400, {12, 10, 8}, 0.2, 1.0, 2));
}

TEST(SampledAgainstExact, UnequalSpheresOfWhichManyAreSwallowed) {
    expect_agreement(test::random_spheres(300, {9, 9, 12}, 0.02, 1.2, 3));
}

}  // namespace
}  // namespace coagula::characterize
