// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/error_model.hpp"

#include <coagula/common/random.hpp>
#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace coagula::diagnose {
namespace {

constexpr Eigen::Index conditions = 40;
constexpr int samples = 5;

double normal(std::uint64_t seed, Eigen::Index condition, int sample, std::uint64_t step) {
    return random_normal(seed, RandomPurpose::test, 100 * step + static_cast<std::uint64_t>(condition),
                         static_cast<std::uint64_t>(sample))
        .x();
}

/// A constant modulus whose errors, 2 %, are as `error` says.
NoiseModel model_of(std::uint64_t seed, const std::function<double(Eigen::Index, int)>& error) {
    Replicates replicates;
    replicates.observable = "storage_modulus";
    replicates.axis = Eigen::VectorXd::LinSpaced(conditions, 1, 40);
    replicates.floor_weights = Eigen::VectorXd::Ones(conditions);
    replicates.values.resize(conditions, samples);
    for (int s = 0; s < samples; ++s) {
        replicates.samples.push_back("sample " + std::to_string(s));
        const double effect = 1 + 0.1 * normal(seed, 0, s, 9);
        for (Eigen::Index c = 0; c < conditions; ++c) {
            replicates.values(c, s) = 1000 * effect * (1 + 0.02 * error(c, s));
        }
    }
    return fit_noise(replicates);
}

TEST(ErrorShape, FindsNoCorrelationAndNoTailsInIndependentNormalErrors) {
    const NoiseModel model = model_of(1, [](Eigen::Index c, int s) { return normal(1, c, s, 1); });
    const ErrorShape shape = shape_of_errors({model}, model);
    EXPECT_LT(shape.law.correlation, 0.12);  // standard error 0.08 above zero
    EXPECT_LT(shape.law.correlation_error, 0.08);
    EXPECT_GT(shape.law.tail, 10);
    EXPECT_NEAR(shape.law.degrees, conditions * samples - conditions - (samples - 1), 20);
    EXPECT_NEAR(shape.factor, 1, 0.01);
}

TEST(ErrorShape, FindsTheCorrelationOfNeighboursAndTheirFullDeviation) {
    Eigen::MatrixXd errors(conditions, samples);
    for (int s = 0; s < samples; ++s) {
        for (Eigen::Index c = 0; c < conditions; ++c) {
            errors(c, s) = c == 0 ? normal(2, c, s, 1) : 0.6 * errors(c - 1, s) + 0.8 * normal(2, c, s, 1);
        }
    }
    const NoiseModel model = model_of(2, [&](Eigen::Index c, int s) { return errors(c, s); });
    const ErrorShape shape = shape_of_errors({model}, model);
    EXPECT_NEAR(shape.law.correlation, 0.6, 0.13);  // standard deviation 0.8 / sqrt(160) = 0.064
    EXPECT_NEAR(shape.law.correlation_error, 0.064, 0.02);
    EXPECT_NEAR(shape.law.degrees, 73, 16);  // as many independent numbers leave the variance as open
    EXPECT_GT(shape.factor, 1);
    EXPECT_NEAR(shape.factor * model.relative.value, 0.02, 0.005);  // three standard deviations of 73 degrees of freedom
}

/// Errors of the phase, which are independent: ten rows of three samples, without an effect of these.
NoiseModel nothing_but_errors(std::uint64_t seed, std::uint64_t table) {
    constexpr Eigen::Index rows = 10;
    Replicates replicates;
    replicates.observable = "phase";
    replicates.axis = Eigen::VectorXd::LinSpaced(rows, 1, 10);
    replicates.floor_weights = Eigen::VectorXd::Ones(rows);
    replicates.levels = Eigen::VectorXd::Constant(rows, 1000);
    replicates.samples = {"A", "B", "C"};
    replicates.values.resize(rows, 3);
    for (int s = 0; s < 3; ++s) {
        for (Eigen::Index row = 0; row < rows; ++row) {
            replicates.values(row, s) = 10 * normal(seed, row, s, table);
        }
    }
    return fit_noise(replicates);
}

/// Means over 300 sessions of three tables of independent errors: 54 degrees of freedom leave 0.14, of which the half below zero is
/// cut off.
TEST(ErrorShape, SaysOfIndependentErrorsThatTheyAreHardlyCorrelated) {
    double correlation = 0;
    double deviation = 0;
    for (std::uint64_t seed = 100; seed < 400; ++seed) {
        const std::vector<NoiseModel> models{nothing_but_errors(seed, 1), nothing_but_errors(seed, 2), nothing_but_errors(seed, 3)};
        ASSERT_FALSE(models[0].sample_estimated);
        const ErrorLaw law = shape_of_errors(models, models[0]).law;
        correlation += law.correlation / 300;
        deviation += law.correlation_error / 300;
    }
    EXPECT_NEAR(correlation, 0.12, 0.02);
    EXPECT_NEAR(deviation, 0.08, 0.02);
}

/// A prior in proportion to 0.9 - rho: mean 0.3, standard deviation 0.9 / sqrt(18).
TEST(ErrorShape, KnowsNothingOfCorrelationWithoutReplicates) {
    NoiseModel alone;
    alone.observable = "storage_modulus";
    alone.relative = {0.02, 0.02, 0.02};
    const ErrorShape shape = shape_of_errors({alone}, alone);
    EXPECT_NEAR(shape.law.correlation, 0.45, 1e-3);
    EXPECT_NEAR(shape.law.correlation_error, 0.9 / std::sqrt(12.0), 1e-3);
    EXPECT_EQ(shape.factor, 1);
    EXPECT_FALSE(std::isfinite(shape.law.tail));
}

TEST(ErrorShape, FindsHeavyTails) {
    // Student's t with five degrees of freedom, of unit variance.
    const auto error = [](Eigen::Index c, int s) {
        double squares = 0;
        for (std::uint64_t k = 2; k < 7; ++k) {
            squares += std::pow(normal(4, c, s, k), 2);
        }
        return normal(4, c, s, 1) / std::sqrt(squares / 5) * std::sqrt(3.0 / 5);
    };
    const NoiseModel model = model_of(4, error);
    const ErrorShape shape = shape_of_errors({model}, model);
    ASSERT_TRUE(std::isfinite(shape.law.tail));
    EXPECT_GT(shape.law.tail, 4);
    EXPECT_LT(shape.law.tail, 12);  // the kurtosis of a finite sample falls short of the true one
    EXPECT_LT(shape.law.degrees, model.degrees);
}

TEST(ErrorShape, DrawsFewReplicatesTowardsTheOthers) {
    NoiseModel few = model_of(5, [](Eigen::Index c, int s) { return normal(5, c, s, 1); });
    const NoiseModel many = few;
    few.relative.value = 0.005;
    few.degrees = 4;
    const ErrorShape shape = shape_of_errors({few, many}, few);
    EXPECT_GT(shape.factor * few.relative.value, 0.015);
    EXPECT_NEAR(shape.law.degrees, 24, 2);  // tail and correlation, hardly there, take a little
}

/// Mean and standard deviation over draws of the lag-one coefficient of whitened errors, 400 rows whose correlation is stated as
/// 0.6.
std::pair<double, double> lag_of_draws(double correlation_error) {
    constexpr std::size_t rows = 400;
    constexpr std::uint64_t draws = 1000;
    DataSet data;
    data.values = Eigen::VectorXd::Zero(rows);
    data.noise.deviation = Eigen::VectorXd::Ones(rows);
    data.noise.correlation = Eigen::VectorXd::Constant(rows, 0.6);
    data.noise.correlation[0] = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        data.noise.previous.push_back(static_cast<Index>(row) - 1);
        Observation one{{}, 0, row};
        one.errors.correlation = 0.6;
        one.errors.correlation_error = correlation_error;
        data.observations.push_back(one);
    }
    double sum = 0;
    double squares = 0;
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
        const Eigen::VectorXd errors = ErrorModel(data).draw(7, draw);
        const double lag = errors.head(rows - 1).dot(errors.tail(rows - 1)) / errors.squaredNorm();
        sum += lag;
        squares += lag * lag;
    }
    const double mean = sum / draws;
    return {mean, std::sqrt(squares / draws - mean * mean)};
}

TEST(DrawnErrors, AreLessIndependentWhereTheirCorrelationIsUncertain) {
    // Where the true correlation is c + d, that of the whitened errors is d to first order; 400 rows scatter by 1 / sqrt(400).
    const auto [known_mean, known_scatter] = lag_of_draws(0);
    EXPECT_NEAR(known_mean, 0, 0.006);
    EXPECT_NEAR(known_scatter, 0.05, 0.005);
    const auto [mean, scatter] = lag_of_draws(0.05);
    EXPECT_NEAR(mean, 0, 0.008);
    EXPECT_NEAR(scatter, std::hypot(0.05, 0.05), 0.007);
}

}  // namespace
}  // namespace coagula::diagnose
