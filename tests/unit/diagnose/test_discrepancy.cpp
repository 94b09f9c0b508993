// SPDX-License-Identifier: GPL-3.0-or-later
// What a named cause leaves over, departures of the level alone, and values at an end of their range.
#include <coagula/diagnose/diagnosis.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "infer/discrepancy.hpp"
#include "responses/linear_modulus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace coagula::diagnose {
namespace {

constexpr double level = 6e5;            // Pa, of the hidden sample
constexpr double relative_error = 0.02;  // errors of G', and of G'' over |G*|

using Modulus = std::function<std::complex<double>(double angular_frequency)>;

/// Frequency sweeps on three samples.
Experiment sweeps_of(const Modulus& modulus, std::uint64_t seed) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    for (const char* sample : {"A", "B", "C"}) {
        Measurement table;
        table.label = std::string("sweep of ") + sample;
        table.sample = sample;
        Column storage{"storage_modulus", "Pa", {}};
        Column loss{"loss_modulus", "Pa", {}};
        const std::vector<double> frequencies = logarithmic_steps(0.5, 600, 16);
        for (std::size_t row = 0; row < frequencies.size(); ++row) {
            const std::complex<double> value = modulus(frequencies[row]);
            const double error = relative_error * std::abs(value);
            storage.values.push_back(value.real() + error * drawn_normal(seed, 2 * row));
            loss.values.push_back(value.imag() + error * drawn_normal(seed, 2 * row + 1));
            storage.standard_errors.push_back(error);
            loss.standard_errors.push_back(error);
        }
        ++seed;
        table.columns = {{"angular_frequency", "rad/s", frequencies}, storage, loss};
        experiment.measurements.push_back(table);
    }
    return experiment;
}

Diagnosis diagnosed(const Experiment& experiment) {
    DiagnosisOptions options;
    options.bootstrap = 399;
    options.errors.sample = 0.02;
    return diagnose(experiment, simulator(), options);
}

double per_torque() {
    return 2 * 1e-3 / (std::numbers::pi * std::pow(0.0125, 4));  // modulus per torque and angle between these plates
}

std::complex<double> with_inertia(double frequency) {
    return level - 3e-5 * frequency * frequency * per_torque();
}

TEST(Discrepancy, IsNothingWhereTheCauseExplainsAll) {
    const Diagnosis found = diagnosed(sweeps_of(with_inertia, 100));
    ASSERT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(name_of(found.credible_set.front()), "tool-inertia");
    EXPECT_FALSE(found.remainder.detected);
    EXPECT_TRUE(found.remainder.observable.empty() && found.remainder.where.empty());
    EXPECT_FALSE(found.causes.front().leaves_remainder);
    EXPECT_FALSE(found.level_alone);
}

/// The inertia is there beside a bump of G'' at 12 rad/s, which nothing in the catalogue makes: it is the best cause, and what it
/// leaves over is placed, but it has no name.
TEST(Discrepancy, IsPlacedBesideACause) {
    const auto bumped = [](double frequency) {
        const double bump = 0.15 * level * std::exp(-0.5 * std::pow(std::log10(frequency / 12) / 0.25, 2));
        return with_inertia(frequency) + std::complex<double>(0, bump);
    };
    const Diagnosis found = diagnosed(sweeps_of(bumped, 100));
    EXPECT_TRUE(found.verdict == Verdict::kind_only || found.verdict == Verdict::none_of_catalogue);
    EXPECT_EQ(name_of(found.credible_set.front()), "tool-inertia");
    EXPECT_EQ(name_of(found.credible_set.back()), "none of the catalogue");
    EXPECT_TRUE(found.causes.front().leaves_remainder);
    EXPECT_TRUE(found.remainder.detected);
    EXPECT_EQ(found.remainder.observable, "loss_modulus");
    EXPECT_GT(found.remainder.largest, 0);
    EXPECT_TRUE(std::any_of(found.remainder.where.begin(), found.remainder.where.end(),
                            [](const CoordinateRange& one) { return one.coordinate == "angular_frequency"; }));
    const EstimatedParameter& inertia = found.causes.front().parameters[1];
    EXPECT_LT(inertia.low, 3.05e-5);
    EXPECT_GT(inertia.high, 2.95e-5);
}

/// A bump of G' where the inertia shows draws the fit without a discrepancy away; beside it the parameters are where a discrepancy
/// about them would have them, too.
TEST(Discrepancy, LeadsTheParametersToWhereTheyStay) {
    const Experiment experiment = sweeps_of(
        [](double frequency) {
            return with_inertia(frequency) + 0.2 * level * std::exp(-0.5 * std::pow(std::log10(frequency / 150) / 0.3, 2));
        },
        100);
    const DataSet data = data_set_of(experiment, {.sample = 0.02});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const SmoothDepartures departures = smooth_departures(data.observations);
    const Fit without = inference.fit({find_mechanism("tool-inertia")});
    const Discrepancy first = find_discrepancy(inference, without, departures);
    const Discrepancy again = find_discrepancy(inference, first.fit, departures);
    const Estimate& beside = first.fit.parameters.front();
    const double half = 0.5 * (beside.high - beside.low);
    EXPECT_GT(std::abs(without.parameters.front().value - beside.value), 0.5 * half);
    EXPECT_NEAR(again.fit.parameters.front().value, beside.value, 0.1 * half);
    EXPECT_NEAR(again.best, first.best, 0.5);
    EXPECT_LT(beside.low, 3e-5);
    EXPECT_GT(beside.high, 3e-5);
}

/// A nonlinear prediction may find other errors, and a lower density, than the fit has found: a discrepancy gains from what the fit
/// has found.
TEST(Discrepancy, GainsNothingFromADensityThatTheFitHasFoundHigher) {
    const Experiment experiment = sweeps_of(with_inertia, 100);
    const DataSet data = data_set_of(experiment, {.sample = 0.02});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const SmoothDepartures departures = smooth_departures(data.observations);
    Fit fit = inference.fit({find_mechanism("tool-inertia")});
    EXPECT_NEAR(fit.log_density, errors.log_density(inference.prediction(fit.model)), 0.1);
    const double alone = find_discrepancy(inference, fit, departures).log_factor;
    fit.log_density += 50;
    EXPECT_NEAR(find_discrepancy(inference, fit, departures).log_factor, alone - 50, 5);
}

/// A smooth material follows by its own functions and keeps the parameters where they are; they are no better known for that.
TEST(Discrepancy, OfASmoothMaterialLeavesNoIntervalOfZeroWidth) {
    Experiment experiment = sweeps_of(
        [](double frequency) { return std::complex<double>(1, 0.2) * with_inertia(frequency) * (frequency > 100 ? 1.2 : 1.0); }, 5);
    experiment.material.kind = MaterialKind::smooth;
    const DataSet data = data_set_of(experiment, {.sample = 0.02});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    for (const char* cause : {"tool-inertia", "bearing-damping"}) {
        const Fit without = inference.fit({find_mechanism(cause)});
        const Discrepancy beside = find_discrepancy(inference, without, smooth_departures(data.observations));
        const Estimate& parameter = beside.fit.parameters.front();
        EXPECT_LT(parameter.low, parameter.high) << cause;
        EXPECT_LE(parameter.low, parameter.value) << cause;
        EXPECT_GE(parameter.high, parameter.value) << cause;
        const Eigen::VectorXd drawn = beside.fit.draws.row(1);
        EXPECT_GT(drawn.maxCoeff(), drawn.minCoeff()) << cause;
    }
}

/// Beside a discrepancy that explains all there is nothing for a cause to add: its parameters lie anywhere in their priors, which
/// is no evidence for it.
TEST(Discrepancy, ThatExplainsAllIsNoEvidenceForACause) {
    const Experiment experiment = sweeps_of(
        [](double frequency) { return level * (1 + 0.03 * std::exp(-std::pow(std::log10(frequency / 12), 2) / 0.1)); }, 100);
    const DataSet data = data_set_of(experiment, {.sample = 0.02});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const SmoothDepartures departures = smooth_departures(data.observations);
    const auto evidence = [&](const Hypothesis& causes) {
        const Fit fit = inference.fit(causes);
        return fit.log_evidence + find_discrepancy(inference, fit, departures).log_factor;
    };
    const double none = evidence({});
    for (const char* cause : {"tool-inertia", "contact-loss", "contact-relaxation", "phase-offset"}) {
        EXPECT_LT(evidence({find_mechanism(cause)}), none + 3) << cause;
    }
}

/// All that is seen is a level below that of the known particles: many causes lower it.
TEST(Discrepancy, OfTheLevelAloneNamesNoCauseAlone) {
    Experiment experiment = sweeps_of([](double) { return level; }, 13);
    const double stiffness = level / linear_modulus(simulator(), {}) * Settings{}.normal_stiffness;
    experiment.sample.normal_stiffness = 1.5 * stiffness;
    experiment.sample.normal_stiffness_error = 0.03;
    const Diagnosis found = diagnosed(experiment);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(found.level_alone);
    EXPECT_NE(found.verdict, Verdict::named);
    EXPECT_TRUE(in_set(found, "none of the catalogue"));
}

/// A tool far heavier than any: the value stays at the end of the range, which is said.
TEST(Discrepancy, AValueAtTheEndOfItsRangeIsFlagged) {
    const auto heavy = [](double frequency) { return std::complex<double>(level - 2.5e-3 * frequency * frequency * per_torque()); };
    const Diagnosis found = diagnosed(sweeps_of(heavy, 17));
    EXPECT_TRUE(found.detected);
    EXPECT_NE(found.verdict, Verdict::named);
    const auto inertia =
        std::find_if(found.causes.begin(), found.causes.end(), [](const Cause& cause) { return cause.name() == "tool-inertia"; });
    ASSERT_NE(inertia, found.causes.end());
    EXPECT_TRUE(inertia->parameters.back().at_end);
    EXPECT_NEAR(inertia->parameters.back().value, 1e-3, 1e-4);
}

}  // namespace
}  // namespace coagula::diagnose
