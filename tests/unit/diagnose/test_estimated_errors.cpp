// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/data_set.hpp"

#include <coagula/common/random.hpp>
#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace coagula::diagnose {
namespace {

constexpr std::size_t rows = 40;
constexpr std::array offsets{0.6, 1.0, 1.4};

/// Three samples of one modulus, apart by their offsets, each with errors of 2 % of its own level.
Experiment apart() {
    Experiment experiment;
    for (std::size_t sample = 0; sample < offsets.size(); ++sample) {
        Measurement table;
        table.kind = MeasurementKind::amplitude_sweep;
        table.label = table.sample = "sample " + std::to_string(sample);
        Column strain{"strain", "1", {}};
        Column storage{"storage_modulus", "Pa", {}};
        for (std::size_t row = 0; row < rows; ++row) {
            strain.values.push_back(1e-4 * std::pow(1.1, static_cast<double>(row)));
            storage.values.push_back(1000 * offsets[sample] * (1 + 0.02 * random_normal(1, RandomPurpose::test, row, sample).x()));
        }
        table.columns = {strain, storage};
        experiment.measurements.push_back(table);
    }
    return experiment;
}

TEST(EstimatedErrors, AreInProportionToTheLevelOfTheirSample) {
    Experiment experiment = apart();
    const std::vector<NoiseModel> models = noise_of_tables(experiment.measurements);
    ASSERT_EQ(models.size(), 1U);
    const ErrorSpec errors = estimated_errors(experiment, models);
    for (std::size_t sample = 0; sample < offsets.size(); ++sample) {
        const ColumnErrors& storage = *find_errors(errors, sample, "storage_modulus");
        ASSERT_EQ(storage.deviations.size(), rows);
        for (const double error : storage.deviations) {
            // 78 degrees of freedom: 8 %; the levels of a row and of a sample 1.2 % and 0.3 %.
            EXPECT_NEAR(error / (20 * offsets[sample]), 1, 0.25) << "sample " << sample;
        }
    }
}

TEST(EstimatedErrors, OfTheTableAreKept) {
    Experiment experiment = apart();
    experiment.measurements[1].columns[1].standard_errors.assign(rows, 7.0);
    const NoiseModel model = fit_noise(find_replicates(experiment.measurements).front());
    const ErrorSpec errors = estimated_errors(experiment, {model});
    EXPECT_EQ(find_errors(errors, 1, "storage_modulus"), nullptr);
    const DataSet data = data_set_of(experiment, errors);
    EXPECT_EQ(data.noise.deviation.segment(static_cast<Index>(rows), static_cast<Index>(rows)),
              Eigen::VectorXd::Constant(static_cast<Index>(rows), 7.0));
    EXPECT_EQ(find_errors(errors, 0, "storage_modulus")->deviations.size(), rows);
}

/// A frequency sweep on a sample of its own, elastic but for an error of the phase.
Measurement lone_sweep() {
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = table.sample = "lone";
    table.columns = {{"angular_frequency", "rad/s", {1, 2, 4, 8, 16}},
                     {"storage_modulus", "Pa", {3000, 3010, 2990, 3005, 2995}},
                     {"loss_modulus", "Pa", {2, -3, 5, -4, 1}}};
    return table;
}

TEST(EstimatedErrors, OfATableWithoutReplicatesAreThoseOfTheOthers) {
    Experiment experiment = apart();
    experiment.measurements.push_back(lone_sweep());
    const ErrorSpec errors = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    for (const double error : find_errors(errors, 3, "storage_modulus")->deviations) {
        EXPECT_NEAR(error / 60, 1, 0.25);  // 2 % of 3000 Pa
    }
    for (const double error : find_errors(errors, 3, "loss_modulus")->deviations) {
        EXPECT_NEAR(error, 15, 1);  // nothing tells but the stated error of the phase, 0.005 of 3000 Pa
    }
}

/// A first row that is far too small has the error of the next, not the smallest of all; one that is less so has its own.
TEST(EstimatedErrors, OfAFirstRowFarBelowTheNextAreTheirs) {
    for (const double factor : {0.1, 0.6}) {
        Experiment experiment = apart();
        Measurement sweep = lone_sweep();
        sweep.columns[1].values[0] *= factor;
        experiment.measurements.push_back(sweep);
        const ErrorSpec spec = estimated_errors(experiment, noise_of_tables(experiment.measurements));
        const std::vector<double>& errors = find_errors(spec, 3, "storage_modulus")->deviations;
        EXPECT_NEAR(errors[0] / errors[1], factor < 0.5 ? 1 : factor, 0.02) << factor;
    }
}

/// Where the moduli rise in proportion to the frequency the ends are as expected.
TEST(EstimatedErrors, OfSteepEndsAreTheirOwn) {
    Experiment experiment = apart();
    Measurement sweep = lone_sweep();
    sweep.columns[1].values = {100, 300, 900, 2700, 8100};
    sweep.columns[2].values = {1, 3, 9, 27, 81};
    experiment.measurements.push_back(sweep);
    const ErrorSpec spec = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    const std::vector<double>& errors = find_errors(spec, 3, "storage_modulus")->deviations;
    for (std::size_t row = 0; row + 1 < errors.size(); ++row) {
        EXPECT_NEAR(errors[row + 1] / errors[row], 3, 1e-9);
    }
}

TEST(EstimatedErrors, OfAFluidAreThoseOfTheTorque) {
    Experiment experiment = apart();
    Measurement oil = lone_sweep();
    oil.fluid_viscosity = 3;
    oil.columns = {oil.columns[0], {"loss_modulus", "Pa", {3, 6, 12, 24, 48}}};
    experiment.measurements.push_back(oil);
    const ErrorSpec errors = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    const Column& loss = experiment.measurements.back().columns[1];
    const ColumnErrors& of_loss = *find_errors(errors, 3, "loss_modulus");
    ASSERT_EQ(of_loss.deviations.size(), loss.values.size());
    for (std::size_t row = 0; row < loss.values.size(); ++row) {
        EXPECT_NEAR(of_loss.deviations[row] / (0.02 * loss.values[row]), 1, 0.25);
    }
}

/// Returns what replicates of so many samples tell of their scatter. @param rows_error of the level of a sample.
NoiseModel of_samples(std::size_t samples, double deviation, double rows_error = 1e-3) {
    NoiseModel model;
    model.sample_estimated = true;
    model.sample.value = deviation;
    model.conditions = 100;
    model.relative.value = 10 * rows_error;
    for (std::size_t sample = 0; sample < samples; ++sample) {
        model.sample_effects.push_back({std::to_string(sample), 0});
    }
    return model;
}

ErrorSpec sample_errors(const std::vector<NoiseModel>& models, double stated = 0.1) {
    return estimated_errors({}, models, {.sample = stated});
}

/// Usual samples scatter by 10 %; replicates that scatter less say so, the more of them the clearer.
TEST(EstimatedErrors, OfSamplesThatAreAlikeAreSmall) {
    EXPECT_EQ(sample_errors({}).sample, 0.1);
    double before = 0.05;
    for (const std::size_t samples : {2U, 3U, 4U, 6U}) {
        const ErrorSpec spec = sample_errors({of_samples(samples, 0.0035)});
        EXPECT_LT(spec.sample, before) << samples;
        before = spec.sample;
    }
    EXPECT_LT(before, 0.006);
    EXPECT_NEAR(sample_errors({of_samples(4, 0.1)}).sample, 0.1, 0.02);
    EXPECT_GT(sample_errors({of_samples(4, 0.3)}).sample, 0.2);
    EXPECT_NEAR(sample_errors({of_samples(5, 0.02)}, 0).sample, 0.02, 1e-12);
}

/// The same numbers of torque twice are no further samples; those of others are.
TEST(EstimatedErrors, OfOtherSamplesCountTogether) {
    const NoiseModel one = of_samples(3, 0.02);
    NoiseModel others = one;
    for (SampleEffect& effect : others.sample_effects) {
        effect.sample += "'";
    }
    EXPECT_NEAR(sample_errors({one, one}).sample, sample_errors({one}).sample, 1e-12);
    EXPECT_NEAR(sample_errors({one, others}).sample, sample_errors({of_samples(5, 0.02)}).sample, 1e-12);
}

/// By weighted draws of the deviation from its prior: quantiles of the posterior.
TEST(EstimatedErrors, OfSamplesAreTheirPosterior) {
    constexpr std::size_t draws = 200'000;
    for (const auto& [samples, seen, rows_error] : {std::tuple(2U, 0.0, 0.004), {3U, 0.01, 0.002}, {5U, 0.2, 0.01}}) {
        std::vector<std::pair<double, double>> weighted;
        double whole = 0;
        for (std::size_t draw = 0; draw < draws; ++draw) {
            const double deviation = 0.1 * std::exp(random_normal(2, RandomPurpose::test, draw, 0).x());
            const double variance = deviation * deviation + rows_error * rows_error;
            const double mean_square = seen * seen + rows_error * rows_error;
            weighted.emplace_back(deviation, std::pow(std::exp(-mean_square / variance) / variance, 0.5 * (samples - 1)));
            whole += weighted.back().second;
        }
        std::sort(weighted.begin(), weighted.end());
        const ErrorSpec spec = sample_errors({of_samples(samples, seen, rows_error)});
        double below = 0;
        std::size_t place = 0;
        for (const double normal : {1.0, 0.0, -1.0}) {  // the smallest deviation has the largest chi-square
            const double part = 0.5 * std::erfc(normal / std::sqrt(2));
            for (; below < part * whole; ++place) {
                below += weighted[place].second;
            }
            const double described = spec.sample / std::sqrt(scaled_chi_square(spec.sample_degrees, normal));
            EXPECT_NEAR(std::log(described / weighted[place].first), 0, 0.3) << samples << " samples, " << part;
        }
    }
}

}  // namespace
}  // namespace coagula::diagnose
