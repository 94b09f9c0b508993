// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/random.hpp>
#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace coagula::diagnose {
namespace {

/// What the values are drawn with.
struct Truth {
    double floor;  ///< Pa, of the stress
    double relative;
    double sample;
};

/// An amplitude sweep over four decades of strain in `samples` samples: G' = 500 / (1 + strain / 0.01) Pa, noise as NoiseModel
/// says.
Replicates simulate(const Truth& truth, Eigen::Index conditions, int samples, std::uint64_t seed) {
    Replicates replicates;
    replicates.observable = "storage_modulus";
    replicates.unit = "Pa";
    replicates.floor_of_stress = true;
    replicates.axis = (Eigen::ArrayXd::LinSpaced(conditions, -5, -1) * std::log(10.0)).exp();
    replicates.floor_weights = replicates.axis.cwiseInverse();
    replicates.values.resize(conditions, samples);
    for (int s = 0; s < samples; ++s) {
        replicates.samples.push_back("sample " + std::to_string(s));
        const double effect = truth.sample * random_normal(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(s)).x();
        for (Eigen::Index c = 0; c < conditions; ++c) {
            const Eigen::Vector3d normal =
                random_normal(seed, RandomPurpose::test, static_cast<std::uint64_t>(c) + 1, static_cast<std::uint64_t>(s));
            const double level = 500 / (1 + replicates.axis[c] / 0.01);
            replicates.values(c, s) = level * (1 + effect) + truth.relative * level * (1 + effect) * normal.x() +
                                      truth.floor * replicates.floor_weights[c] * normal.y();
        }
    }
    return replicates;
}

bool covers(const Estimate& estimate, double truth) {
    return estimate.low <= truth && truth <= estimate.high;
}

/// 200 data sets; the number of 95 % intervals that cover is binomial: 180 .. 198 holds with probability 0.997 when the coverage is
/// 0.95. Profile likelihoods of few samples cover slightly less than stated, which the lower bound leaves room for.
TEST(Noise, IntervalsCoverWhatTheValuesWereDrawnWith) {
    constexpr int sets = 200;
    const Truth truth{5e-4, 0.03, 0.2};
    std::array<int, 3> covered{};
    Eigen::Array3d mean = Eigen::Array3d::Zero();
    for (int set = 0; set < sets; ++set) {
        const NoiseModel noise = fit_noise(simulate(truth, 25, 6, static_cast<std::uint64_t>(set) + 1));
        covered[0] += covers(noise.floor, truth.floor) ? 1 : 0;
        covered[1] += covers(noise.relative, truth.relative) ? 1 : 0;
        covered[2] += covers(noise.sample, truth.sample) ? 1 : 0;
        mean += Eigen::Array3d(noise.floor.value, noise.relative.value, noise.sample.value) / sets;
    }
    for (const int count : covered) {
        EXPECT_GE(count, 180);
        EXPECT_LE(count, 198);
    }
    // Standard deviations of a mean over 200 sets: 1 %, 0.5 % and 2.2 %; a root of an unbiased variance is low by about 1/(4 dof).
    EXPECT_NEAR(mean[0], truth.floor, 0.05 * truth.floor);
    EXPECT_NEAR(mean[1], truth.relative, 0.02 * truth.relative);
    EXPECT_NEAR(mean[2], truth.sample * (1 - 1.0 / 20), 0.08 * truth.sample);
    RecordProperty("floor", covered[0]);
    RecordProperty("relative", covered[1]);
    RecordProperty("sample", covered[2]);
}

TEST(Noise, TellsThatThereIsNoFloorOrNoSampleEffect) {
    const NoiseModel no_floor = fit_noise(simulate({0, 0.03, 0.2}, 40, 6, 3));
    EXPECT_EQ(no_floor.floor.low, 0);
    EXPECT_LT(no_floor.floor.high, 3e-4);
    const NoiseModel no_sample = fit_noise(simulate({5e-4, 0.03, 0}, 40, 6, 4));
    EXPECT_EQ(no_sample.sample.low, 0);
    EXPECT_LT(no_sample.sample.high, 0.03);
    EXPECT_TRUE(covers(no_sample.relative, 0.03));
}

TEST(Noise, PredictsTheEffectOfEachSample) {
    Replicates replicates = simulate({2e-4, 0.02, 0}, 50, 4, 5);
    replicates.values.col(3) *= 0.7;  // the others then lie a little above the mean
    const NoiseModel noise = fit_noise(replicates);
    ASSERT_EQ(noise.sample_effects.size(), 4U);
    EXPECT_EQ(noise.sample_effects[3].sample, "sample 3");
    const double ratio = (1 + noise.sample_effects[3].effect) / (1 + noise.sample_effects[0].effect);
    EXPECT_NEAR(ratio, 0.7, 0.01);
    EXPECT_NEAR(noise.autocorrelation, 0, 0.25);  // 200 independent residuals: standard deviation 0.07
}

TEST(Noise, NoticesResidualsThatFollowEachOther) {
    Replicates replicates = simulate({0, 0.001, 0.1}, 50, 4, 6);
    for (Eigen::Index c = 0; c < 50; ++c) {
        for (Eigen::Index s = 0; s < 4; ++s) {
            replicates.values(c, s) *= 1 + 0.05 * std::sin(0.1 * static_cast<double>(c) * static_cast<double>(s + 1));
        }
    }
    EXPECT_GT(fit_noise(replicates).autocorrelation, 0.8);
}

TEST(Noise, IsTheSameForACompleteTableWithMissingRowsAdded) {
    Replicates replicates = simulate({5e-4, 0.03, 0.2}, 25, 4, 7);
    const NoiseModel before = fit_noise(replicates);
    replicates.values.conservativeResize(26, 4);
    replicates.values.row(25) << std::nan(""), 100, std::nan(""), std::nan("");  // one value tells nothing about scatter
    replicates.axis.conservativeResize(26);
    replicates.axis[25] = 0.2;
    replicates.floor_weights.conservativeResize(26);
    replicates.floor_weights[25] = 5;
    const NoiseModel after = fit_noise(replicates);
    EXPECT_EQ(before.relative.value, after.relative.value);
    EXPECT_EQ(before.sample.high, after.sample.high);
    EXPECT_EQ(after.values, 100U);
}

TEST(Noise, StatesItsDefaultsWhereThereAreNoReplicates) {
    Replicates single = simulate({5e-4, 0.03, 0.2}, 25, 1, 8);
    const NoiseModel noise = fit_noise(single, {.relative = 0.07, .sample = 0.12, .floor = 2});
    EXPECT_FALSE(noise.rows_estimated);
    EXPECT_FALSE(noise.sample_estimated);
    EXPECT_EQ(noise.relative.value, 0.07);
    EXPECT_EQ(noise.sample.value, 0.12);
    EXPECT_EQ(noise.floor.value, 2);
    EXPECT_FALSE(noise.averages_to_zero || noise.borrowed_from);
}

TEST(Noise, RepeatsOnOneSampleSayNothingAboutSamples) {
    Replicates repeats = simulate({5e-4, 0.03, 0}, 25, 4, 9);
    repeats.samples.assign(4, "A");
    const NoiseModel noise = fit_noise(repeats, {.sample = 0.12});
    EXPECT_TRUE(noise.rows_estimated);
    EXPECT_FALSE(noise.sample_estimated);
    EXPECT_EQ(noise.sample.value, 0.12);
    EXPECT_TRUE(covers(noise.relative, 0.03));
}

TEST(Noise, LeavesTheFloorOutWhereLevelsAreAlike) {
    Replicates replicates = simulate({0, 0.03, 0.2}, 25, 4, 10);
    replicates.floor_weights = Eigen::VectorXd::Ones(25);
    for (Eigen::Index c = 0; c < 25; ++c) {
        replicates.values.row(c) *= (1 + replicates.axis[c] / 0.01);  // all levels 500 Pa
    }
    const NoiseModel noise = fit_noise(replicates);
    EXPECT_EQ(noise.floor.value, 0);
    EXPECT_FALSE(noise.floor_is_told);
    EXPECT_TRUE(covers(noise.relative, 0.03));
}

/// Five samples of a material whose phase goes from 0.1 to 1.4 rad, read with errors of 2 % of the torque and 0.005 rad of the
/// phase.
std::vector<Measurement> sweeps_of_torque_and_phase() {
    std::vector<Measurement> tables;
    for (std::uint64_t sample = 0; sample < 5; ++sample) {
        Measurement table;
        table.label = table.sample = "sample " + std::to_string(sample);
        table.columns = {{"angular_frequency", "rad/s", {}}, {"storage_modulus", "Pa", {}}, {"loss_modulus", "Pa", {}}};
        const double effect = 1 + 0.1 * random_normal(11, RandomPurpose::test, 0, sample).x();
        for (std::uint64_t row = 0; row < 40; ++row) {
            const Eigen::Vector3d normal = random_normal(11, RandomPurpose::test, row + 1, sample);
            const double phase = 0.1 + 1.3 * static_cast<double>(row) / 39 + 0.005 * normal.x();
            const double size = 1000 * effect * (1 + 0.02 * normal.y());
            table.columns[0].values.push_back(std::pow(1.2, static_cast<double>(row)));
            table.columns[1].values.push_back(size * std::cos(phase));
            table.columns[2].values.push_back(size * std::sin(phase));
        }
        tables.push_back(table);
    }
    return tables;
}

TEST(Noise, OfATableWithBothModuliIsThatOfTorqueAndPhase) {
    const std::vector<NoiseModel> models = noise_of_tables(sweeps_of_torque_and_phase());
    ASSERT_EQ(models.size(), 2U);
    EXPECT_EQ(models[0].observable, "complex_modulus");
    EXPECT_EQ(models[1].observable, "phase");
    EXPECT_NEAR(models[0].relative.value, 0.02, 0.003);    // 156 degrees of freedom: 6 %
    EXPECT_NEAR(models[1].relative.value, 0.005, 0.0008);  // 160
    EXPECT_TRUE(covers(models[0].sample, 0.1));
    EXPECT_FALSE(models[1].sample_estimated);
    EXPECT_NEAR(models[1].levels[0], 1000, 100);
}

}  // namespace
}  // namespace coagula::diagnose
