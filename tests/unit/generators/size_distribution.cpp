// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/size_distribution.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace coagula::generators {
namespace {

double relative_deviation(const Eigen::VectorXd& radii) {
    return std::sqrt((radii.array() - radii.mean()).square().mean()) / radii.mean();
}

TEST(SizeDistribution, MonodisperseRadiiAreAllTheMean) {
    const Eigen::VectorXd radii = draw_radii({.mean_radius = 0.25e-6}, 5, 1);
    EXPECT_EQ(radii, Eigen::VectorXd::Constant(5, 0.25e-6));
}

TEST(SizeDistribution, NormalRadiiHaveTheGivenMomentsEvenForFewParticles) {
    for (const Index n : {10, 1000, 100000}) {
        const SizeDistribution sizes{.kind = SizeKind::normal, .mean_radius = 2e-7, .relative_deviation = 0.2};
        const Eigen::VectorXd radii = draw_radii(sizes, n, 3);
        EXPECT_NEAR(radii.mean(), 2e-7, 1e-20);
        // Cutting at three deviations takes 1.35 % off the standard deviation.
        EXPECT_NEAR(relative_deviation(radii), 0.2 * 0.98658, n == 10 ? 0.015 : 2e-4 + 1.0 / static_cast<double>(n));
        EXPECT_GT(radii.minCoeff(), 2e-7 * (1 - 0.6) * 0.95);
    }
}

TEST(SizeDistribution, LognormalRadiiFollowTheDistributionFunction) {
    const SizeDistribution sizes{.kind = SizeKind::lognormal, .mean_radius = 1.0, .relative_deviation = 0.4};
    Eigen::VectorXd radii = draw_radii(sizes, 2000, 4);
    std::sort(radii.begin(), radii.end());
    const double sigma = std::sqrt(std::log1p(0.16));
    // Against the uncut distribution with its mean moved to the logarithmic median; the cut (0.27 %) bounds the difference.
    const double median = radii[1000];
    EXPECT_NEAR(median, std::exp(-0.5 * sigma * sigma), 0.01);
    for (Index i = 50; i < 2000; i += 50) {
        const double share = 0.5 * std::erfc(-std::log(radii[i] / median) / sigma / std::sqrt(2.0));
        EXPECT_NEAR(share, static_cast<double>(i) / 2000, 3e-3);
    }
}

TEST(SizeDistribution, TablesGiveTheNearestWholeNumbers) {
    SizeDistribution sizes{.kind = SizeKind::table};
    sizes.table_radius = Eigen::Vector3d(1, 2, 3);
    sizes.table_fraction = Eigen::Vector3d(5, 3, 2);  // any scale
    const Eigen::VectorXd radii = draw_radii(sizes, 11, 1);
    EXPECT_EQ((radii.array() == 1).count(), 6);  // 5.5, 3.3, 2.2: the largest remainder gets the odd one
    EXPECT_EQ((radii.array() == 2).count(), 3);
    EXPECT_EQ((radii.array() == 3).count(), 2);
}

TEST(SizeDistribution, OrderDependsOnTheSeedAlone) {
    const SizeDistribution sizes{.kind = SizeKind::normal, .mean_radius = 1, .relative_deviation = 0.1};
    EXPECT_EQ(draw_radii(sizes, 100, 7), draw_radii(sizes, 100, 7));
    EXPECT_NE(draw_radii(sizes, 100, 7), draw_radii(sizes, 100, 8));
    const Eigen::VectorXd radii = draw_radii(sizes, 1000, 7);
    EXPECT_FALSE(std::is_sorted(radii.begin(), radii.end()));
    // Neighbours in number are not alike in size.
    const Eigen::ArrayXd centred = radii.array() - radii.mean();
    EXPECT_LT(std::abs((centred.head(999) * centred.tail(999)).mean() / centred.square().mean()), 0.15);
}

TEST(SizeDistribution, RejectsMissingAndImpossibleParameters) {
    EXPECT_THROW(draw_radii({}, 5, 1), std::invalid_argument);
    EXPECT_THROW(draw_radii({.mean_radius = 1}, 0, 1), std::invalid_argument);
    EXPECT_THROW(draw_radii({.kind = SizeKind::normal, .mean_radius = 1}, 5, 1), std::invalid_argument);
    EXPECT_THROW(draw_radii({.kind = SizeKind::normal, .mean_radius = 1, .relative_deviation = 0.4}, 5, 1), std::invalid_argument);
    EXPECT_THROW(draw_radii({.kind = SizeKind::lognormal, .mean_radius = 1, .relative_deviation = -0.1}, 5, 1),
                 std::invalid_argument);
    SizeDistribution table{.kind = SizeKind::table};
    EXPECT_THROW(draw_radii(table, 5, 1), std::invalid_argument);
    table.table_radius = Eigen::Vector2d(1, -2);
    table.table_fraction = Eigen::Vector2d(0.5, 0.5);
    EXPECT_THROW(draw_radii(table, 5, 1), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::generators
