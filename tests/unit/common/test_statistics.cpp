// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/statistics.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace coagula;

TEST(MeanWithError, IsThatOfAHandCalculation) {
    const MeanWithError found = mean_and_standard_error(Eigen::Vector4d(2, 4, 4, 6));
    EXPECT_EQ(found.count, 4);
    EXPECT_DOUBLE_EQ(found.mean, 4);
    EXPECT_DOUBLE_EQ(found.standard_deviation, std::sqrt(8.0 / 3));
    EXPECT_DOUBLE_EQ(found.standard_error, std::sqrt(2.0 / 3));
}

TEST(MeanWithError, OfOneValueHasNoError) {
    const MeanWithError found = mean_and_standard_error(Eigen::VectorXd::Constant(1, 3));
    EXPECT_DOUBLE_EQ(found.mean, 3);
    EXPECT_TRUE(std::isnan(found.standard_deviation));
    EXPECT_TRUE(std::isnan(found.standard_error));
}

TEST(MeanWithError, RefusesNothingAndWhatIsNoNumber) {
    EXPECT_THROW(mean_and_standard_error(Eigen::VectorXd()), std::invalid_argument);
    EXPECT_THROW(mean_and_standard_error(Eigen::Vector2d(1, unset)), std::invalid_argument);
}
