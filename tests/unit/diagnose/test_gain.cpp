// SPDX-License-Identifier: GPL-3.0-or-later
#include "hidden_effects.hpp"
#include "infer/gain.hpp"

#include <coagula/common/random.hpp>
#include <coagula/diagnose/mechanism.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// A gap series of eight rows; only those from `first` on are readable.
std::vector<std::vector<bool>> folds_of_eight(std::size_t first) {
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.sample = "one";
    table.columns = {{"gap", "m", std::vector<double>(8, 1e-3)}};
    Experiment experiment;
    experiment.measurements = {table};
    std::vector<Observation> observations;
    for (std::size_t row = first; row < 8; ++row) {
        observations.push_back({{}, 0, row});
    }
    return choose_folds(experiment, observations, 0.3);
}

TEST(Gain, HoldsOutTheEndOfTheOnlyTable) {
    EXPECT_EQ(folds_of_eight(2), (std::vector<std::vector<bool>>{{false, false, false, false, true, true}}));
}

TEST(Gain, HoldsOutNothingWhereFewerThanFourNumbersRemain) {
    EXPECT_TRUE(folds_of_eight(3).empty());
}

/// Every sample once, with all of its tables.
TEST(Gain, HoldsOutEverySampleInTurn) {
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.columns = {{"gap", "m", std::vector<double>(4, 1e-3)}};
    Experiment experiment;
    std::vector<Observation> observations;
    for (const char* sample : {"one", "two", "one", "three"}) {
        table.sample = sample;
        for (std::size_t row = 0; row < 4; ++row) {
            observations.push_back({{}, experiment.measurements.size(), row});
        }
        experiment.measurements.push_back(table);
    }
    const std::vector<std::vector<bool>> folds = choose_folds(experiment, observations, 0.3);
    ASSERT_EQ(folds.size(), 3U);
    for (std::size_t k = 0; k < observations.size(); ++k) {
        int times = 0;
        for (const std::vector<bool>& held : folds) {
            times += held[k] ? 1 : 0;
        }
        EXPECT_EQ(times, 1);
    }
    for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_TRUE(folds[0][row] && folds[0][row + 8]) << "both tables of a sample go together";
    }
}

/// Sweeps of four samples, of which the last scatters twenty times as much.
Experiment sweeps_of_four() {
    Experiment experiment;
    for (std::uint64_t sample = 0; sample < 4; ++sample) {
        Measurement table;
        table.label = table.sample = std::to_string(sample);
        table.columns = {{"angular_frequency", "rad/s", {}}, {"storage_modulus", "Pa", {}}};
        for (std::uint64_t row = 0; row < 20; ++row) {
            table.columns[0].values.push_back(std::pow(1.5, static_cast<double>(row)));
            table.columns[1].values.push_back(
                1000 * (1 + (sample == 3 ? 0.2 : 0.01) * random_normal(5, RandomPurpose::test, row, sample).x()));
        }
        experiment.measurements.push_back(table);
    }
    return experiment;
}

TEST(Gain, KnowsNothingOfTheErrorsOfWhatIsHeldOut) {
    const Experiment experiment = sweeps_of_four();
    DiagnosisOptions options;
    options.errors = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    const DataSet data = data_set_of(experiment, options.errors);
    ASSERT_EQ(data.size(), 80);
    EXPECT_GT(data.noise.deviation[0], 30);
    std::vector<bool> held_out(80, false);
    std::fill(held_out.begin() + 60, held_out.end(), true);
    const DataSet rest = with_errors_of_the_rest(data, held_out, experiment, Eigen::VectorXd::Zero(80), options);
    EXPECT_EQ(rest.values, data.values);
    Experiment alone = sweeps_of_four();
    alone.measurements.pop_back();
    const DataSet others = data_set_of(alone, estimated_errors(alone, noise_of_tables(alone.measurements)));
    EXPECT_LT((rest.noise.deviation.head(60) - others.noise.deviation).cwiseAbs().maxCoeff(), 1e-6 * others.noise.deviation[0]);
    EXPECT_NEAR(rest.noise.deviation[70], 10, 3);  // what is expected of a sample like the others
}

/// Sweeps of three samples with losses like those of a solvent's drag. @param last factor on the losses of the last one.
Experiment dragged_samples(double last) {
    constexpr double level = 6e5;  // Pa
    constexpr double error = 0.01;
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    for (std::uint64_t sample = 0; sample < 3; ++sample) {
        Measurement table;
        table.label = table.sample = std::to_string(sample);
        table.columns = {{"angular_frequency", "rad/s", logarithmic_steps(1, 100, 8)},
                         {"storage_modulus", "Pa", {}},
                         {"loss_modulus", "Pa", {}}};
        for (std::size_t row = 0; row < 8; ++row) {
            const double loss = 0.01 * std::pow(table.columns[0].values[row], 0.7) * (sample == 2 ? last : 1.0);
            table.columns[1].values.push_back(level * (1 + error * drawn_normal(sample, 2 * row)));
            table.columns[2].values.push_back(level * (loss + error * drawn_normal(sample, 2 * row + 1)));
        }
        experiment.measurements.push_back(table);
    }
    return experiment;
}

/// What the last sample is predicted to show by the base model and by the drag that the others ask for.
Gain gain_of_last(double factor) {
    const Experiment experiment = dragged_samples(factor);
    DiagnosisOptions options;
    options.errors = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    const DataSet data = data_set_of(experiment, options.errors);
    std::vector<bool> held_out;
    for (const Observation& one : data.observations) {
        held_out.push_back(one.measurement == 2);
    }
    return measure_gain(data, {held_out}, experiment, simulator(), {find_mechanism("solvent-drag")}, options);
}

/// Nor do the errors of the drag that structures leave follow rows that are held out.
TEST(Gain, PredictsWhatIsHeldOutFromTheRestAlone) {
    constexpr double same = 0.1;  // Pa, of moduli of up to 6e5
    const Gain found = gain_of_last(1);
    const Gain other = gain_of_last(2);
    ASSERT_EQ(names_of(found.chosen), std::vector<std::string>{"solvent-drag"});
    ASSERT_EQ(found.predictions.size(), 16U);
    for (std::size_t k = 0; k < found.predictions.size(); ++k) {
        EXPECT_NEAR(other.predictions[k].extended, found.predictions[k].extended, same);
        EXPECT_NEAR(other.predictions[k].base, found.predictions[k].base, same);
        EXPECT_NEAR(other.predictions[k].flexible, found.predictions[k].flexible, same);
    }
    EXPECT_LT(other.elpd_difference, found.elpd_difference - 10) << "twice the losses are no surprise";
}

}  // namespace
}  // namespace coagula::diagnose
