// SPDX-License-Identifier: GPL-3.0-or-later
// What few structures leave open in how Hertz contacts stiffen.
#include "responses/contact_response.hpp"
#include "responses/hertz_scatter.hpp"

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::diagnose {
namespace {

/// Structures that differ from their mean by so many of the stated errors.
Eigen::MatrixXd structures_apart(double errors) {
    const Eigen::VectorXd first = hertz_scatter(400, Eigen::MatrixXd::Zero(hertz_axis.count, 1)).errors.col(0);
    Eigen::MatrixXd logarithms(hertz_axis.count, 4);
    logarithms << first, -first, first, -first;
    return errors * logarithms;
}

TEST(HertzScatter, FallsWithTheRootOfParticlesAndStructures) {
    const Eigen::MatrixXd one = hertz_scatter(400, Eigen::MatrixXd::Zero(hertz_axis.count, 1)).errors;
    const Eigen::MatrixXd larger = hertz_scatter(1600, Eigen::MatrixXd::Zero(hertz_axis.count, 1)).errors;
    EXPECT_LT((larger.leftCols(3) - one.leftCols(3) / 2).norm(), 1e-12);
    EXPECT_EQ(larger.col(3), one.col(3));  // what the curve leaves out does not fall
    // Four that differ by just as much as stated: the sum of squares is that of three degrees of freedom.
    const Eigen::MatrixXd four = hertz_scatter(400, structures_apart(std::sqrt(0.75))).errors;
    EXPECT_LT((four.leftCols(3) - one.leftCols(3) / 2).norm(), 1e-12);
}

TEST(HertzScatter, FollowsTheStructuresAtHand) {
    const HertzScatter alike = hertz_scatter(400, structures_apart(0));
    const HertzScatter apart = hertz_scatter(400, structures_apart(3));
    EXPECT_EQ(alike.degrees, 9);
    // Six degrees of freedom as stated and the sum of the squares at hand, of three.
    EXPECT_NEAR(alike.errors.col(0).norm() / apart.errors.col(0).norm(), std::sqrt(6.0 / (6 + 4 * 9)), 1e-9);
}

/// Relative, in a row: as the curve itself would move.
TEST(HertzScatter, MovesTheFundamentalAsItMovesTheCurve) {
    Settings settings;
    settings.contact_preload = 1e-4;
    const double high = 1e-4 * hertz_axis.high;
    const Eigen::RowVectorXd beyond = contact_errors(simulator(), settings, 1e3 * high);
    const Eigen::RowVectorXd within = contact_errors(simulator(), settings, 0.001 * hertz_axis.low * 1e-4);
    EXPECT_LT(within.norm(), 1e-12);  // small strains are the level
    EXPECT_EQ(contact_degrees(simulator()), 7);
    EXPECT_NEAR(beyond[3], 0.5 * 0.0238, 2e-4);
}

}  // namespace
}  // namespace coagula::diagnose
