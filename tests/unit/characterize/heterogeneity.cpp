// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/heterogeneity.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace coagula::characterize {
namespace {

constexpr double r0 = 0.25e-6;

/// Points on 1 - erf((r/r0 - b) / (a sqrt 2)) with a mean that serves as the start of the fit.
PoreSizes error_function_curve(double a, double b, double largest, double noise = 0) {
    PoreSizes pores;
    pores.radius = r0 * Eigen::VectorXd::LinSpaced(200, 0.0, largest);
    pores.exclusion_probability.resize(200);
    for (Index k = 0; k < 200; ++k) {
        const double wiggle = noise * ((k % 2 == 0) ? 1 : -1);
        pores.exclusion_probability[k] = 1 - std::erf((pores.radius[k] / r0 - b) / (a * std::numbers::sqrt2)) + wiggle;
    }
    pores.mean = 0.8 * a * r0;
    return pores;
}

TEST(Heterogeneity, FindsTheParametersOfAnErrorFunction) {
    for (const auto& [a, b] : {std::pair{0.26, 0.02}, {0.4, 0.0}, {0.594, -0.05}}) {
        const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(error_function_curve(a, b, 2), r0);
        EXPECT_NEAR(fit.a, a, 1e-9);
        EXPECT_NEAR(fit.b, b, 1e-9);
        EXPECT_LT(fit.rms_residual, 1e-9);
        EXPECT_LT(fit.a_stderr, 1e-9);
    }
}

TEST(Heterogeneity, StandardErrorsComeFromTheCurvature) {
    constexpr double a = 0.4, b = 0.01, noise = 1e-3;
    const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(error_function_curve(a, b, 1.5, noise), r0);
    EXPECT_NEAR(fit.rms_residual, noise, 1e-5);
    // The Hessian of half the sum of squares by finite differences.
    const PoreSizes model = error_function_curve(fit.a, fit.b, 1.5);
    const double step = 1e-5;
    const Eigen::VectorXd by_a =
        (error_function_curve(fit.a + step, fit.b, 1.5).exclusion_probability - model.exclusion_probability) / step;
    const Eigen::VectorXd by_b =
        (error_function_curve(fit.a, fit.b + step, 1.5).exclusion_probability - model.exclusion_probability) / step;
    const double determinant = by_a.squaredNorm() * by_b.squaredNorm() - std::pow(by_a.dot(by_b), 2);
    const double variance = fit.rms_residual * fit.rms_residual * 200 / 198;
    EXPECT_NEAR(fit.a_stderr / std::sqrt(variance * by_b.squaredNorm() / determinant), 1, 1e-3);
    EXPECT_NEAR(fit.b_stderr / std::sqrt(variance * by_a.squaredNorm() / determinant), 1, 1e-3);
}

TEST(Heterogeneity, LiesAtTheMinimumOfTheSumOfSquares) {
    const PoreSizes pores = error_function_curve(0.4, 0.01, 1.5, 2e-2);
    const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(pores, r0);
    const auto squares = [&](double a, double b) {
        return (error_function_curve(a, b, 1.5).exclusion_probability - pores.exclusion_probability).squaredNorm();
    };
    const double least = squares(fit.a, fit.b);
    for (const double step : {-1e-4, 1e-4}) {
        EXPECT_GT(squares(fit.a + step, fit.b), least);
        EXPECT_GT(squares(fit.a, fit.b + step), least);
    }
}

TEST(Heterogeneity, RefusesWhatIsNoCurve) {
    const PoreSizes good = error_function_curve(0.4, 0, 2);
    EXPECT_THROW(fit_degree_of_heterogeneity(PoreSizes{}, r0), std::invalid_argument);
    EXPECT_THROW(fit_degree_of_heterogeneity(good, 0), std::invalid_argument);
    PoreSizes broken = good;
    broken.exclusion_probability[3] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(fit_degree_of_heterogeneity(broken, r0), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
