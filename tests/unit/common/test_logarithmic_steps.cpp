// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/logarithmic_steps.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/complaint.hpp"

namespace coagula {
namespace {

TEST(LogarithmicSteps, RiseAndFallByEqualRatiosAndEndWhereTheyShould) {
    for (const auto& [from, to] : {std::pair{0.3, 700.0}, std::pair{1e-2, 1.1e-4}}) {
        const std::vector<double> values = logarithmic_steps(from, to, 17);
        ASSERT_EQ(values.size(), 17U);
        EXPECT_EQ(values.front(), from);
        EXPECT_EQ(values.back(), to);
        const double ratio = std::pow(to / from, 1.0 / 16);
        for (std::size_t k = 1; k < values.size(); ++k) {
            EXPECT_NEAR(values[k] / values[k - 1] / ratio, 1, 1e-13);
        }
    }
    EXPECT_EQ(logarithmic_steps(2, 5, 2), (std::vector<double>{2, 5}));
}

TEST(LogarithmicSteps, RefuseWhatHasNoRatio) {
    using testing::complaint;
    EXPECT_NE(complaint([] { logarithmic_steps(0, 1, 3); }).find("the first of logarithmic steps is 0"), std::string::npos);
    EXPECT_NE(complaint([] { logarithmic_steps(1, -1, 3); }).find("the last of logarithmic steps is -1"), std::string::npos);
    EXPECT_NE(complaint([] { logarithmic_steps(1, std::numeric_limits<double>::infinity(), 3); }).find("the last"),
              std::string::npos);
    EXPECT_NE(complaint([] { logarithmic_steps(1, 2, 1); }).find("at least 2"), std::string::npos);
}

}  // namespace
}  // namespace coagula
