// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of pages.
#include <gtest/gtest.h>

#include "html.hpp"

namespace coagula::report {
namespace {

/// A posterior of one to rounding is no certainty.
TEST(Html, NoProbabilityIsCertain) {
    EXPECT_EQ(probability_text(1), "> 99.9 %");
    EXPECT_EQ(probability_text(0.9996), "> 99.9 %");
    EXPECT_EQ(probability_text(0.9994), "99.9 %");
    EXPECT_EQ(probability_text(0.5), "50 %");
    EXPECT_EQ(probability_text(0.0009), "< 0.1 %");
    EXPECT_EQ(probability_text(0), "< 0.1 %");
    EXPECT_EQ(percent(1), "100 %");
}

}  // namespace
}  // namespace coagula::report
