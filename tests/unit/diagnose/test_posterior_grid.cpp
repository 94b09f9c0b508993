// SPDX-License-Identifier: GPL-3.0-or-later
#include "infer/posterior_grid.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coagula::diagnose {
namespace {

/// A normal density in the unit square, of integral 1.
EvaluateNode normal_density(const Eigen::Vector2d& mean, const Eigen::Matrix2d& covariance) {
    return [=](const Eigen::VectorXd& place) {
        const Eigen::Vector2d away = place - mean;
        const double exponent = -0.5 * away.dot(covariance.inverse() * away);
        return Node{.log_weight = exponent - std::log(2 * std::numbers::pi * std::sqrt(covariance.determinant()))};
    };
}

PosteriorGrid grid_along_axes(const EvaluateNode& evaluate) {
    ClosingGrid closing(2, evaluate);
    closing.close_in(7);
    return closing.grid();
}

TEST(PosteriorGrid, IntegratesWhatLiesAlongTheAxes) {
    const Eigen::Matrix2d covariance = Eigen::Vector2d(1e-4, 4e-6).asDiagonal();
    const PosteriorGrid grid = grid_along_axes(normal_density({0.3, 0.62}, covariance));
    EXPECT_NEAR(grid.log_evidence(), 0, 1e-3);
    EXPECT_NEAR(grid.quantile(0, 0.5), 0.3, 1e-4);
    EXPECT_NEAR(grid.quantile(0, 0.95) - grid.quantile(0, 0.05), 2 * 1.645 * 0.01, 0.06 * 0.0329);  // a cell is a deviation wide
    EXPECT_NEAR(grid.quantile(1, 0.95) - grid.quantile(1, 0.05), 2 * 1.645 * 0.002, 0.06 * 0.00658);
}

TEST(PosteriorGrid, FollowsARidgeAcrossTheAxes) {
    Eigen::Matrix2d covariance;
    covariance << 1e-4, 0.9999e-4, 0.9999e-4, 1e-4;
    const Eigen::Vector2d mean(0.41, 0.57);
    const EvaluateNode density = normal_density(mean, covariance);
    EXPECT_LT(grid_along_axes(density).effective_nodes(), 2.5 * 2.5) << "the grid along the axes would do";
    const PosteriorGrid grid = grid_about(mean, Eigen::LLT<Eigen::Matrix2d>(covariance).matrixL(), density);
    EXPECT_NEAR(grid.log_evidence(), 0, 1e-3);
    EXPECT_NEAR(grid.quantile(1, 0.95) - grid.quantile(1, 0.05), 2 * 1.645 * 0.01, 1e-3);
    EXPECT_GT(grid.effective_nodes(), 2.5 * 2.5);
    EXPECT_FALSE(grid.clipped);
    EXPECT_TRUE(grid.reaches(mean + Eigen::Vector2d(0.03, 0.03)));  // three deviations along the ridge
    EXPECT_FALSE(grid.reaches(mean + Eigen::Vector2d(0.03, -0.03)));
}

/// A bent ridge along which the density still grows where a box about the first nodes ends: while that is so, the grid is not
/// settled, and it says that it is cut.
TEST(PosteriorGrid, IsNotSettledWhereItsBoxCutsThePosterior) {
    constexpr double across = 0.0024;
    constexpr double along = 0.19;
    const EvaluateNode density = [](const Eigen::VectorXd& place) {
        const double ridge = 0.5 - 0.078 * place[1] + 0.024 * place[1] * place[1];
        const double aside = (place[0] - ridge) / across;
        const double ahead = (place[1] - 0.85) / along;
        return Node{.log_weight = -0.5 * (aside * aside + ahead * ahead)};
    };
    ClosingGrid closing(2, density);
    bool was_cut = false;
    for (int round = 0; round < 12 && !closing.is_settled(); ++round) {
        closing.close_in(1);
        was_cut = was_cut || closing.grid().cut;
        EXPECT_FALSE(closing.grid().cut && closing.is_settled());
    }
    EXPECT_TRUE(was_cut) << "the ridge is no test";
    EXPECT_FALSE(closing.grid().cut);
    EXPECT_GT(closing.grid().quantile(1, 0.95), 0.95);
    EXPECT_NEAR(closing.grid().quantile(1, 0.05), 0.516, 0.01) << "of a normal density that ends at 1";
}

/// A slope of 4 logarithms over the prior needs no finer grid; one of 40 does.
TEST(PosteriorGrid, HasFewNodesWhereThePosteriorHardlyDiffersFromThePrior) {
    const auto slope_of = [](double slope) {
        return ClosingGrid(2, [=](const Eigen::VectorXd& place) { return Node{.log_weight = slope * place[0]}; });
    };
    const ClosingGrid gentle = slope_of(4);
    EXPECT_TRUE(gentle.is_settled());
    EXPECT_EQ(gentle.grid().nodes.size(), 25U);
    EXPECT_NEAR(gentle.grid().log_evidence(), std::log(std::expm1(4) / 4), 0.8 * 0.8 / 24 + 0.01);
    const ClosingGrid steep = slope_of(40);
    EXPECT_FALSE(steep.is_settled());
    EXPECT_GT(steep.grid().nodes.size(), 100U);
}

/// Half the width that 90 % of a normal distribution have, in standard deviations.
constexpr double half_width = 1.6449;

/// Two nodes on the whole peak are enough: between nodes the logarithm of the density is a parabola.
TEST(PosteriorGrid, QuantilesAndPeakLieBetweenTheNodes) {
    for (const double mean : {0.31, 0.4711, 0.5, 0.757}) {
        for (const double deviation : {0.012, 0.02, 0.06}) {
            ClosingGrid closing(1, [=](const Eigen::VectorXd& place) {
                const double away = (place[0] - mean) / deviation;
                return Node{.log_weight = -0.5 * away * away};
            });  // 41 nodes over the prior
            const PosteriorGrid& grid = closing.grid();
            EXPECT_NEAR(grid.quantile(0, 0.05), mean - half_width * deviation, 0.01 * deviation) << mean << " " << deviation;
            EXPECT_NEAR(grid.quantile(0, 0.95), mean + half_width * deviation, 0.01 * deviation) << mean << " " << deviation;
            const auto peak = grid.peak();
            EXPECT_NEAR(peak ? (*peak)[0] : grid.places[grid.best()][0], mean, 0.05 * deviation) << mean << " " << deviation;
        }
    }
}

TEST(PosteriorGrid, PeakOfARidgeLiesBetweenTheNodes) {
    Eigen::Matrix2d covariance;
    covariance << 4e-4, 3e-4, 3e-4, 4e-4;
    const Eigen::Vector2d mean(0.417, 0.5731);
    const PosteriorGrid grid = grid_along_axes(normal_density(mean, covariance));
    const auto peak = grid.peak();
    ASSERT_TRUE(peak.has_value());
    EXPECT_LT((*peak - mean).norm(), 1e-6);
    EXPECT_GT((grid.places[grid.best()] - mean).norm(), 1e-3);
    const Eigen::VectorXd beside = mean + Eigen::Vector2d(0.003, -0.002);
    const PosteriorGrid about =
        grid_about(beside, Eigen::LLT<Eigen::Matrix2d>(covariance).matrixL(), normal_density(mean, covariance));
    ASSERT_TRUE(about.peak().has_value());
    EXPECT_LT((*about.peak() - mean).norm(), 1e-6);
}

/// A slope that ends with the prior: nodes along such an axis were fewer each second time that the grid closed in.
TEST(PosteriorGrid, IsRefinedUntilItsNodesTellTheQuantiles) {
    for (const double steepness : {30.0, 45.0, 60.0, 90.0, 200.0}) {
        ClosingGrid closing(1, [=](const Eigen::VectorXd& place) { return Node{.log_weight = steepness * (place[0] - 1)}; });
        closing.close_in(7);
        closing.refine(2);
        const PosteriorGrid& grid = closing.grid();
        EXPECT_TRUE(grid.resolved_axes(0.3).front()) << steepness;
        EXPECT_NEAR(grid.log_evidence(), -std::log(steepness), 0.1) << steepness;
        EXPECT_NEAR(steepness * (1 - grid.quantile(0, 0.05)), -std::log(0.05), 0.05) << steepness;
        EXPECT_NEAR(steepness * (1 - grid.quantile(0, 0.95)), -std::log(0.95), 0.01) << steepness;
    }
}

/// A covariance that is far too wide leaves few nodes that count.
TEST(PosteriorGrid, AboutAModeIsRefinedByItsOwnNodes) {
    const Eigen::Vector2d mean(0.41, 0.57);
    const Eigen::Matrix2d covariance = 1e-6 * Eigen::Matrix2d::Identity();
    const EvaluateNode density = normal_density(mean, covariance);
    const Eigen::Vector2d beside = mean + Eigen::Vector2d(0.002, -0.003);
    const PosteriorGrid coarse = grid_about(beside, 0.008 * Eigen::Matrix2d::Identity(), density);
    EXPECT_FALSE(coarse.is_fine());
    const PosteriorGrid fine = refined(coarse, density);
    EXPECT_TRUE(fine.is_fine());
    EXPECT_NEAR(fine.log_evidence(), 0, 0.02);
    EXPECT_NEAR(fine.quantile(0, 0.95) - fine.quantile(0, 0.05), 2 * half_width * 1e-3, 5e-5);
}

TEST(PosteriorGrid, NormalPosteriorsAreCutOffByThePrior) {
    const auto [low, high] = middle_within_prior(0.4, 0.01, 0.9);
    EXPECT_NEAR(low, 0.4 - half_width * 0.01, 1e-6);
    EXPECT_NEAR(high, 0.4 + half_width * 0.01, 1e-6);
    // At an end a half of it is left; far beyond that an exponential, of deviation^2 over the distance.
    const auto [half_low, half_high] = middle_within_prior(1, 0.01, 0.9);
    EXPECT_NEAR(half_low, 1 - 1.95996 * 0.01, 1e-5);
    EXPECT_NEAR(half_high, 1 - 0.062707 * 0.01, 1e-5);
    const auto [far_low, far_high] = middle_within_prior(-0.2, 0.01, 0.9);
    EXPECT_NEAR(far_low, -std::log(0.95) * 0.01 / 20, 2e-6);
    EXPECT_NEAR(far_high, -std::log(0.05) * 0.01 / 20, 2e-5);
    const auto [beyond_low, beyond_high] = middle_within_prior(5, 1e-6, 0.9);
    EXPECT_LT(beyond_low, beyond_high);
    EXPECT_LE(beyond_high, 1);
}

/// One axis that is known to a hundredth of its prior beside three that are not known at all, or to a third.
TEST(PosteriorGrid, ClosesInOnANarrowAxisBesideFlatOnes) {
    for (const double middle : {0.3, 0.5, 0.86}) {
        std::size_t evaluated = 0;
        ClosingGrid closing(4, [&](const Eigen::VectorXd& place) {
            ++evaluated;
            const double wide = (place[3] - 0.5) / 0.33;
            const double narrow = (place[1] - middle) / 0.01;
            return Node{.log_weight = -0.5 * (narrow * narrow + wide * wide)};
        });
        closing.close_in(5);
        const PosteriorGrid& grid = closing.grid();
        EXPECT_TRUE(closing.is_settled()) << middle;
        const double along_wide = 0.33 * std::sqrt(2 * std::numbers::pi) * std::erf(0.5 / 0.33 / std::numbers::sqrt2);
        EXPECT_NEAR(grid.log_evidence(), std::log(0.01 * std::sqrt(2 * std::numbers::pi) * along_wide), 0.1) << middle;
        EXPECT_NEAR(grid.quantile(1, 0.05), middle - 1.645 * 0.01, 0.004) << middle;
        EXPECT_NEAR(grid.quantile(1, 0.95), middle + 1.645 * 0.01, 0.004) << middle;
        EXPECT_NEAR(grid.quantile(0, 0.95), 0.95, 0.01) << middle;
        EXPECT_LT(evaluated, 4000U) << middle;
    }
}

TEST(PosteriorGrid, LeavesOutWhatThePriorDoesNotAllow) {
    const Eigen::Matrix2d covariance = 1e-4 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d corner(0.0, 0.5);  // half of it lies below 0
    const PosteriorGrid grid =
        grid_about(corner, Eigen::LLT<Eigen::Matrix2d>(covariance).matrixL(), normal_density(corner, covariance));
    EXPECT_NEAR(std::exp(grid.log_evidence()), 0.5, 0.06);  // a row of cells is cut through its middle: two of three parts count
    EXPECT_GE(grid.quantile(0, 0.01), 0);
    EXPECT_TRUE(grid.clipped);
}

/// Between two nodes far apart lie the quarter and three quarters of what the likelier one has.
TEST(PosteriorGrid, StiffnessIsThatOfAllNodes) {
    PosteriorGrid grid;
    grid.nodes = {{.log_stiffness = 1, .deviation = 0.03, .log_weight = std::log(0.75)},
                  {.log_stiffness = 3, .deviation = 0.1, .log_weight = std::log(0.25)}};
    EXPECT_NEAR(grid.log_stiffness_quantile(0.375, 0), 1, 1e-9);
    EXPECT_NEAR(grid.log_stiffness_quantile(0.875, 0), 3, 1e-9);
    EXPECT_NEAR(grid.log_stiffness_quantile(0.375 + 0.75 * 0.3413447461, 0.04), 1.05, 1e-6);
    grid.nodes.pop_back();
    EXPECT_NEAR(grid.log_stiffness_quantile(0.95, 0.04) - 1, 1.644854 * 0.05, 1e-6);
}

}  // namespace
}  // namespace coagula::diagnose
