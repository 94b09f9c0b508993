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

}  // namespace
}  // namespace coagula::diagnose
