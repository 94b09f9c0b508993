// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/special_functions.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

TEST(SpecialFunctions, NormalQuantilesInvertTheErrorFunction) {
    for (const double probability : {1e-12, 0.025, 0.5, 0.9, 0.999}) {
        const double x = coagula::normal_quantile(probability);
        EXPECT_NEAR(0.5 * std::erfc(-x / std::numbers::sqrt2), probability, 1e-14 + 1e-10 * probability);
        EXPECT_NEAR(coagula::upper_normal_quantile(probability), -x, 1e-13 * (1 + std::abs(x)));
    }
    const double far = coagula::upper_normal_quantile(1e-300);
    EXPECT_NEAR(std::log(0.5 * std::erfc(far / std::numbers::sqrt2)), std::log(1e-300), 1e-9);
}

TEST(SpecialFunctions, StudentWithOneDegreeIsCauchy) {
    for (const double probability : {0.6, 0.75, 0.975}) {
        const double x = std::tan(std::numbers::pi * (probability - 0.5));
        EXPECT_NEAR(coagula::student_quantile(1, probability), x, 1e-12 * x);
        EXPECT_NEAR(coagula::above_in_student(1, x), 1 - probability, 1e-14);
    }
}

TEST(SpecialFunctions, GammaOfOneIsExponential) {
    for (const double x : {0.1, 1.0, 7.0}) {
        EXPECT_NEAR(coagula::gamma_p(1, x), -std::expm1(-x), 1e-15);
        EXPECT_NEAR(coagula::gamma_p_derivative(1, x), std::exp(-x), 1e-15);
    }
}

TEST(SpecialFunctions, DigammaAndTrigammaAreDerivatives) {
    EXPECT_NEAR(coagula::digamma(1), -std::numbers::egamma, 1e-15);
    EXPECT_NEAR(coagula::trigamma(1), std::numbers::pi * std::numbers::pi / 6, 1e-14);
    for (const double x : {0.3, 2.5, 40.0}) {
        const double step = 1e-4 * x;
        EXPECT_NEAR(coagula::digamma(x), (std::lgamma(x + step) - std::lgamma(x - step)) / (2 * step), 1e-6 * (1 + 1 / x));
        EXPECT_NEAR(coagula::trigamma(x), (coagula::digamma(x + step) - coagula::digamma(x - step)) / (2 * step),
                    1e-6 * (1 + 1 / (x * x)));
    }
}

}  // namespace
