// SPDX-License-Identifier: GPL-3.0-or-later
// The power law with a critical value: exact data, other ways to the same minimum, coverage of the interval, data that decide
// nothing.
#include <coagula/common/random.hpp>
#include <coagula/mechanics/power_law.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/complaint.hpp"

namespace coagula::mechanics {
namespace {

Eigen::VectorXd vector(std::initializer_list<double> values) {
    return Eigen::VectorXd::Map(values.begin(), static_cast<Index>(values.size()));
}

/// Moduli that follow the law.
PowerLawData exact_data(const Eigen::VectorXd& a, double c, double a0, double beta) {
    return {a, c * (a.array() - a0).pow(beta), {}};
}

/// The same with normal noise of the given deviation [Pa].
PowerLawData noisy_data(double deviation, std::uint64_t seed) {
    PowerLawData data = exact_data(Eigen::VectorXd::LinSpaced(12, 0.4, 0.6), 2e6, 0.36, 0.5);
    for (Index k = 0; k < data.a.size(); ++k) {
        data.modulus[k] += deviation * random_normal(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(k))[0];
    }
    return data;
}

double sum_of_squares(const PowerLawData& data, double c, double a0, double beta) {
    return (data.modulus.array() - c * (data.a.array() - a0).pow(beta)).square().sum();
}

TEST(PowerLaw, FindsTheLawThatExactDataFollow) {
    for (const double beta : {0.15, 0.5, 1.0, 2.0, 3.75}) {
        for (const double a0 : {0.2, 0.35, 0.3899}) {
            const PowerLawData data = exact_data(vector({0.6, 0.39, 0.45, 0.41, 0.52}), 3e6, a0, beta);
            const PowerLawFit fit = fit_power_law(data).fit;
            EXPECT_EQ(fit.minimum, PowerLawMinimum::inside);
            EXPECT_NEAR(fit.law.a0, a0, 1e-6) << beta;
            EXPECT_NEAR(fit.law.beta, beta, 2e-5) << a0;
            EXPECT_NEAR(fit.law.c() / 3e6, 1, 5e-5);
            EXPECT_NEAR(fit.law.modulus(0.5) / (3e6 * std::pow(0.5 - a0, beta)), 1, 1e-7);
            EXPECT_TRUE(fit.a0_low <= fit.law.a0 && fit.law.a0 <= fit.a0_high);
            EXPECT_NEAR(fit.a0_high - fit.a0_low, 0, 1e-5);
        }
    }
}

/// A second method: nothing near the minimum, in all three parameters at once, is smaller, and the gradient vanishes.
TEST(PowerLaw, NoNeighbourHasLessSquares) {
    const PowerLawData data = noisy_data(1e5, 3);
    const PowerLaw law = fit_power_law(data).fit.law;
    EXPECT_NEAR(sum_of_squares(data, law.c(), law.a0, law.beta) / law.sum_of_squares, 1, 1e-12);
    for (const double dc : {-1e-3, 0.0, 1e-3}) {
        for (const double da : {-1e-3, 0.0, 1e-3}) {
            for (const double db : {-1e-3, 0.0, 1e-3}) {
                EXPECT_GE(sum_of_squares(data, law.c() * (1 + dc), law.a0 + da, law.beta + db), law.sum_of_squares * (1 - 1e-12));
            }
        }
    }
}

TEST(PowerLaw, ProfileIsTheLeastSumOfSquaresAtEachCriticalValue) {
    const PowerLawData data = noisy_data(1e5, 4);
    const PowerLawAnalysis found = fit_power_law(data);
    double last = -1e9;
    for (const PowerLaw& law : found.profile.laws) {
        EXPECT_GT(law.a0, last);
        last = law.a0;
        EXPECT_GE(law.sum_of_squares, found.fit.law.sum_of_squares);
        EXPECT_EQ(fit_power_law_at(data, law.a0).sum_of_squares, law.sum_of_squares);
    }
    const PowerLaw at = fit_power_law_at(data, 0.3);
    for (const double change : {-1e-4, 1e-4}) {
        EXPECT_GT(sum_of_squares(data, at.c(), 0.3, at.beta + change), at.sum_of_squares);
        EXPECT_GT(sum_of_squares(data, at.c() * (1 + change), 0.3, at.beta), at.sum_of_squares);
    }
}

/// Where the lowest structure can be met or given up there are two minima in beta: a fine scan finds no smaller value.
TEST(PowerLaw, BestExponentOfTwoMinima) {
    const PowerLawData data{vector({0.4, 0.41, 0.43, 0.5, 0.6}), vector({0.3e6, 0.1e6, 0.5e6, 0.9e6, 2e6}), {}};
    for (const double distance : {1e-7, 1e-5, 1e-3, 0.1, 3.0}) {
        const PowerLaw law = fit_power_law_at(data, 0.4 - distance);
        for (int k = -2000; k <= 20000; ++k) {
            const Eigen::ArrayXd shape = ((data.a.array() - law.a0).log() * (law.beta + 1e-3 * k)).exp();
            const double c = (shape * data.modulus.array()).sum() / shape.square().sum();
            if (std::isfinite(c)) {
                EXPECT_GE((data.modulus.array() - c * shape).square().sum(), law.sum_of_squares * (1 - 1e-9)) << distance;
            }
        }
    }
}

TEST(PowerLaw, WeightsCountStructures) {
    PowerLawData repeated = noisy_data(1e5, 5);
    PowerLawData weighted = repeated;
    weighted.standard_error = Eigen::VectorXd::Constant(12, 1e5);
    weighted.standard_error[2] /= std::sqrt(3.0);
    repeated.a.conservativeResize(14);
    repeated.modulus.conservativeResize(14);
    repeated.a.tail(2).setConstant(repeated.a[2]);
    repeated.modulus.tail(2).setConstant(repeated.modulus[2]);
    const PowerLawFit one = fit_power_law(repeated).fit;
    const PowerLawFit other = fit_power_law(weighted).fit;
    EXPECT_NEAR(one.law.a0, other.law.a0, 1e-7);
    EXPECT_NEAR(one.law.beta, other.law.beta, 1e-6);
    EXPECT_NEAR(one.law.sum_of_squares / 1e10 / other.law.sum_of_squares, 1, 1e-9);
    // Residual variance against the given one.
    const double ratio = std::sqrt(one.law.sum_of_squares / 11) / 1e5;
    EXPECT_NEAR(one.a0_stderr / other.a0_stderr / ratio, 1, 1e-6);
    EXPECT_NEAR(one.beta_stderr / other.beta_stderr / ratio, 1, 1e-6);
}

TEST(PowerLaw, DoesNotDependOnOrderOrUnit) {
    const PowerLawData data = noisy_data(2e4, 6);
    const PowerLawData turned{data.a.reverse() * 100, data.modulus.reverse() / 1e6, {}};
    const PowerLawFit one = fit_power_law(data).fit;
    const PowerLawFit other = fit_power_law(turned).fit;
    EXPECT_NEAR(other.law.a0 / (100 * one.law.a0), 1, 1e-6);
    EXPECT_NEAR(other.a0_stderr / (100 * one.a0_stderr), 1, 1e-4);
    ASSERT_TRUE(one.bounded_below && other.bounded_below);
    EXPECT_NEAR(other.a0_low / (100 * one.a0_low), 1, 1e-6);
    EXPECT_NEAR(other.law.beta, one.law.beta, 1e-6);
    EXPECT_NEAR(other.law.modulus(50) * 1e6 / one.law.modulus(0.5), 1, 1e-9);
}

/// Where noise is small the profile is a parabola: interval and standard errors agree, and both with the scatter of repetitions.
TEST(PowerLaw, StandardErrorsAreTheScatterOfRepetitions) {
    constexpr int repetitions = 400;
    Eigen::ArrayXd a0(repetitions);
    double mean_square_error = 0;
    for (int k = 0; k < repetitions; ++k) {
        const PowerLawFit fit = fit_power_law(noisy_data(2e3, 100 + static_cast<std::uint64_t>(k)), {.leave_one_out = false}).fit;
        a0[k] = fit.law.a0;
        mean_square_error += fit.a0_stderr * fit.a0_stderr / repetitions;
        const double quantile = 2.262157;  // of Student's t, 97.5 %, 9 degrees of freedom (tables)
        EXPECT_NEAR((fit.a0_high - fit.a0_low) / (2 * quantile * fit.a0_stderr), 1, 0.05);
    }
    const double scatter = std::sqrt((a0 - a0.mean()).square().mean());
    EXPECT_NEAR(scatter / std::sqrt(mean_square_error), 1, 4 / std::sqrt(2.0 * repetitions));
}

/// The intervals hold the true a0 as often as they say, far from the parabola and with known and unknown errors.
TEST(PowerLaw, IntervalsCoverTheCriticalValue) {
    constexpr int repetitions = 600;
    constexpr double confidence = 0.9;
    for (const bool errors_known : {false, true}) {
        int covered = 0;
        for (int k = 0; k < repetitions; ++k) {
            PowerLawData data = noisy_data(4e4, 1000 + static_cast<std::uint64_t>(k));
            if (errors_known) {
                data.standard_error = Eigen::VectorXd::Constant(12, 4e4);
            }
            const PowerLawFit fit = fit_power_law(data, {.confidence = confidence, .points = 100, .leave_one_out = false}).fit;
            covered += (!fit.bounded_below || fit.a0_low < 0.36) && 0.36 < fit.a0_high ? 1 : 0;
        }
        const double deviation = std::sqrt(confidence * (1 - confidence) / repetitions);
        EXPECT_NEAR(static_cast<double>(covered) / repetitions, confidence, 4 * deviation) << errors_known;
    }
}

TEST(PowerLaw, EndsOfTheIntervalHaveItsConfidence) {
    const PowerLawData data = noisy_data(3e4, 7);
    for (const double confidence : {0.5, 0.9, 0.95}) {
        const PowerLawAnalysis found = fit_power_law(data, {.confidence = confidence});
        ASSERT_TRUE(found.fit.bounded_below && found.fit.bounded_above);
        for (std::size_t k = 0; k < found.profile.laws.size(); ++k) {
            const double a0 = found.profile.laws[k].a0;
            const bool inside = found.fit.a0_low <= a0 && a0 <= found.fit.a0_high;
            EXPECT_EQ(found.profile.confidence[static_cast<Index>(k)] <= confidence, inside) << a0;
        }
    }
}

TEST(PowerLaw, TheStructureThatDecides) {
    // A straight line through zero at 0.3, and one structure at the lower end that lies on the way to zero at 0.38.
    PowerLawData data = exact_data(vector({0.4, 0.42, 0.45, 0.5, 0.55, 0.6}), 1e7, 0.3, 1);
    data.modulus[0] = 0.5e6;
    const PowerLawAnalysis found = fit_power_law(data);
    ASSERT_EQ(found.without.size(), 6U);
    EXPECT_EQ(found.decisive, 0);
    EXPECT_NEAR(found.without[0].law.a0, 0.3, 1e-6);
    EXPECT_NEAR(found.without[0].law.beta, 1, 1e-5);
    EXPECT_GT(found.fit.law.a0, 0.35);
}

TEST(PowerLaw, ThreeStructuresFitWithoutAnyError) {
    PowerLawData data = exact_data(vector({0.4, 0.45, 0.6}), 2e6, 0.37, 0.4);
    const PowerLawAnalysis found = fit_power_law(data);
    EXPECT_NEAR(found.fit.law.a0, 0.37, 1e-6);
    EXPECT_EQ(found.fit.degrees_of_freedom, 0);
    EXPECT_FALSE(found.fit.bounded_below || found.fit.bounded_above);
    EXPECT_TRUE(std::isnan(found.fit.a0_stderr));
    EXPECT_EQ(found.profile.confidence.size(), 0);
    for (const PowerLawFit& without : found.without) {
        EXPECT_TRUE(std::isnan(without.law.a0));
    }
    EXPECT_EQ(found.decisive, -1);
    data.standard_error = Eigen::VectorXd::Constant(3, 1e3);
    const PowerLawFit known = fit_power_law(data).fit;
    EXPECT_TRUE(known.bounded_below && known.bounded_above);
    EXPECT_GT(known.a0_stderr, 0);
}

TEST(PowerLaw, DataWithoutAThreshold) {
    const Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(8, 0.4, 0.6);
    const PowerLawFit exponential = fit_power_law({a, 1e4 * (10 * a.array()).exp(), {}}).fit;
    EXPECT_EQ(exponential.minimum, PowerLawMinimum::far_away);
    EXPECT_FALSE(exponential.bounded_below);
    EXPECT_TRUE(std::isnan(exponential.a0_stderr));
    // One low structure, and a plateau: beta goes to 0 and a0 to the smallest a.
    Eigen::VectorXd step = Eigen::VectorXd::Constant(8, 1e6);
    step[0] = 2e5;
    step[3] *= 1.01;
    const PowerLawFit apart = fit_power_law({a, step, {}}).fit;
    EXPECT_EQ(apart.minimum, PowerLawMinimum::lowest_a);
    EXPECT_FALSE(apart.bounded_above);
    EXPECT_EQ(apart.a0_high, 0.4);
}

TEST(PowerLaw, RefusesWhatCannotBeFitted) {
    const auto sentence = [](const PowerLawData& data, const PowerLawOptions& options = {}) -> std::string {
        return coagula::testing::complaint([&] { fit_power_law(data, options); });
    };
    const Eigen::VectorXd a = vector({0.4, 0.5, 0.6});
    const Eigen::VectorXd modulus = vector({1e6, 2e6, 3e6});
    EXPECT_EQ(sentence({a.head(2), modulus.head(2), {}}),
              "a power law has three parameters and needs at least three structures, but there are 2");
    EXPECT_EQ(sentence({vector({0.4, 0.4, 0.6}), modulus, {}}),
              "a power law has three parameters and needs three different degrees of heterogeneity, but there are only 2");
    EXPECT_EQ(sentence({vector({0.4, 0.4 + 1e-10, 0.4 + 2e-10}), modulus, {}}),
              "the degrees of heterogeneity differ by rounding only: all are 0.4");
    EXPECT_EQ(sentence({a, Eigen::VectorXd::Constant(3, 1e6), {}}),
              "the modulus is 1e+06 Pa for every degree of heterogeneity: such data have no exponent and no critical value");
    EXPECT_EQ(sentence({a, vector({0, 1e6, 2e6}), {}}), "the modulus of structure 1 is 0 Pa, but must be finite and positive");
    EXPECT_EQ(sentence({vector({0.4, unset, 0.6}), modulus, {}}),
              "the degree of heterogeneity of structure 2 is nan, but must lie between -1e+06 and 1e+06");
    EXPECT_EQ(sentence({a, modulus, vector({1e5, 1e5, -1})}),
              "the standard error of structure 3 is -1 Pa, but must be finite and positive");
    EXPECT_EQ(sentence({vector({0.4, 0.5, 1e23}), modulus, {}}),
              "the degree of heterogeneity of structure 3 is 1e+23, but must lie between -1e+06 and 1e+06");
    EXPECT_EQ(
        sentence({vector({0.5, 0.5 + 1e-15, 1e5}), modulus, {}}),
        "the degrees of heterogeneity 0.5 and 0.500000000000001 are the same within rounding beside the range of all, 99999.5");
    EXPECT_EQ(sentence({a, vector({1e308, 1e308, 1.5e308}), {}}),
              "the modulus of structure 1 is 1e+308 Pa, but must lie between 1e-60 and 1e+60 Pa");
    EXPECT_EQ(sentence({a, modulus.head(2), {}}),
              "a power law needs one modulus (and one standard error or none at all) for each of the 3 structures");
    EXPECT_EQ(sentence({a, modulus, {}}, {.confidence = 1}),
              "the confidence of the interval of a0 is 1, but must be greater than 0 and less than 1");
    EXPECT_EQ(sentence({a, modulus, {}}, {.points = 3}), "the profile of a0 has 3 points, but needs at least 10");
    EXPECT_THROW(fit_power_law_at({a, modulus, {}}, 0.4), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
