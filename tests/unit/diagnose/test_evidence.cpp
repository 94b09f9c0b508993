// SPDX-License-Identifier: GPL-3.0-or-later
// The evidence of causes, which is integrated over their parameters and the stiffness.
#include "infer/hypothesis.hpp"

#include "hidden_effects.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/diagnose/mechanism.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace coagula::diagnose {
namespace {

/// Frequency sweeps of samples of these levels.
Experiment samples_of_levels(const std::vector<double>& levels) {
    constexpr double error = 0.01;
    const std::vector<double> angular_frequencies = logarithmic_steps(0.5, 50, 6);
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    for (std::size_t number = 0; number < levels.size(); ++number) {
        Column storage{"storage_modulus", "Pa", {}};
        for (std::size_t row = 0; row < angular_frequencies.size(); ++row) {
            const double value = 6e5 * levels[number];
            storage.values.push_back(value * (1 + error * drawn_normal(number, row)));
            storage.standard_errors.push_back(error * value);
        }
        const std::string sample = "sample " + std::to_string(number);
        experiment.measurements.push_back({.kind = MeasurementKind::frequency_sweep,
                                           .label = sample,
                                           .sample = sample,
                                           .columns = {{"strain", "1", std::vector<double>(angular_frequencies.size(), 1e-4)},
                                                       {"angular_frequency", "rad/s", angular_frequencies},
                                                       storage},
                                           .left_out = {}});
    }
    return experiment;
}

/// Samples that differ far more than two degrees of freedom say that they do: where the deviation of samples is integrated out, the
/// density exceeds that at its middle by many logarithms. What every place of a prior explains alike has the evidence of the base
/// model all the same.
TEST(Evidence, OfACauseThatScalesAllModuliIsThatOfTheBaseModel) {
    const Experiment experiment = samples_of_levels({0.7, 1, 1.4});
    DataSet data = data_set_of(experiment, {});
    data.effect = 0.02;
    data.effect_degrees = 2;
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const Fit base = inference.fit({});
    const Prediction best = inference.prediction(base.model);
    ASSERT_GT(errors.log_density(best) - errors.log_density(best, {}, Accuracy::middle), 60)
        << "the data ask for no larger deviation";
    for (const char* cause : {"shear-stiffness", "bond-bending"}) {
        EXPECT_NEAR(inference.fit({find_mechanism(cause)}).log_evidence, base.log_evidence, 0.05) << cause;
    }
}

/// Of a stiff sample with losses, between plates.
Experiment sweep_with_losses() {
    constexpr double level = 6e5;  // Pa
    constexpr double error = 0.01;
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    const std::vector<double> frequencies = logarithmic_steps(0.5, 50, 12);
    Column storage{"storage_modulus", "Pa", {}};
    Column loss{"loss_modulus", "Pa", {}};
    for (std::size_t row = 0; row < frequencies.size(); ++row) {
        storage.values.push_back(level * (1 + error * drawn_normal(7, 2 * row)));
        loss.values.push_back(level * (0.05 * std::pow(frequencies[row], 0.1) + error * drawn_normal(7, 2 * row + 1)));
        storage.standard_errors.push_back(error * level);
        loss.standard_errors.push_back(error * level);
    }
    experiment.measurements.push_back({.kind = MeasurementKind::frequency_sweep,
                                       .label = "sweep",
                                       .sample = "A",
                                       .columns = {{"angular_frequency", "rad/s", frequencies}, storage, loss},
                                       .left_out = {}});
    return experiment;
}

/// The sweep with losses, and the inference about it.
struct InferredSweep {
    const Experiment experiment = sweep_with_losses();
    const DataSet data = data_set_of(experiment, {});
    const Forward forward{experiment, data.observations, simulator()};
    const ErrorModel errors{data};
    const Inference inference{forward, errors};
};

const double log_prior_of_stiffness = std::log(8 * std::numbers::ln10);  // eight decades

/// Logarithm of the integral of the density over the logarithm of the stiffness, by small steps about its highest point.
double log_integral_over_stiffness(const Forward& forward, const ErrorModel& errors, Model model) {
    constexpr double step = 0.05;
    constexpr double small_step = 0.01;
    constexpr double around = 0.6;
    const auto density = [&](double log_stiffness) {
        model.settings.normal_stiffness = std::exp(log_stiffness);
        return errors.log_density(forward.prediction(model));
    };
    double highest = 0;
    for (double place = highest; place < 14; place += step) {
        highest = density(place) > density(highest) ? place : highest;
    }
    std::vector<double> logarithms;
    for (double place = highest - around; place < highest + around; place += small_step) {
        logarithms.push_back(density(place));
    }
    return log_sum(logarithms) + std::log(small_step);
}

/// A partner of which the data tell only that it is not large: the mode lies anywhere, and the posterior is as wide as the prior.
/// The losses alone are a narrow ridge across the axes.
TEST(Evidence, OfAPairIsThatOfTheCauseWhereItsPartnerDoesLittle) {
    const InferredSweep sweep;
    const Inference& inference = sweep.inference;
    const Hypothesis losses{find_mechanism("contact-loss")};
    constexpr int places = 40;
    std::vector<double> logarithms;
    for (int place = 0; place < places * places; ++place) {
        const int row = place / places;
        const Eigen::Vector2d at(place % places + 0.5, row + 0.5);
        logarithms.push_back(log_integral_over_stiffness(sweep.forward, sweep.errors, model_at(losses, at / places, 1)));
    }
    const double integral = log_mean(logarithms) - log_prior_of_stiffness;
    EXPECT_NEAR(inference.fit(losses).log_evidence, integral, 0.1);
    for (const char* partner : {"bearing-damping", "tool-compliance", "gap-error"}) {
        EXPECT_NEAR(inference.fit({losses.front(), find_mechanism(partner)}).log_evidence, integral, 0.3) << partner;
    }
}

/// Part of the draws of a parameter below a value.
double part_below(const PosteriorDraws& draws, Index parameter, double value) {
    return static_cast<double>((draws.row(parameter).array() < value).count()) / static_cast<double>(draws.cols());
}

/// Walkers in the prior of all parameters, of which the stiffness is one, come to what the grid says.
TEST(Evidence, OfTheGridIsThatOfAnEnsemble) {
    const InferredSweep sweep;
    const Inference& inference = sweep.inference;
    const Hypothesis losses{find_mechanism("contact-loss")};
    const Fit fit = inference.fit(losses);
    const Fit drawn = inference.fit(losses, ensemble());
    const Problem problem = inference.problem(losses);
    const PosteriorDraws& draws = drawn.draws;
    ASSERT_EQ(draws.rows(), 3);
    // 500 sweeps of which one in some ten is independent: 600 draws, whose parts are known to 0.01 at the ends. Of an exponent that
    // the data would have at the end of its prior, the interval of the grid reaches that end. That of the stiffness also has what
    // so few structures leave open, which the draws do not have: both intervals are compared below.
    for (Index parameter = 1; parameter < 3; ++parameter) {
        const auto number = static_cast<std::size_t>(parameter);
        const Estimate& by_grid = fit.parameters[number - 1];
        const MechanismParameter& prior = problem.priors[number];
        EXPECT_NEAR(part_below(draws, parameter, by_grid.low), 0.05, 0.04) << prior.name;
        EXPECT_NEAR(part_below(draws, parameter, by_grid.high), by_grid.high < 0.99 * prior.high ? 0.95 : 1.0, 0.04) << prior.name;
    }
    EXPECT_TRUE(std::isnan(drawn.log_evidence)) << "an ensemble gives none";
    EXPECT_GT(drawn.log_density, fit.log_density - 0.3) << "one of 25 600 places is near the mode";
    EXPECT_NEAR(drawn.stiffness.low, fit.stiffness.low, 0.1 * (fit.stiffness.high - fit.stiffness.low));
    EXPECT_NEAR(drawn.stiffness.high, fit.stiffness.high, 0.1 * (fit.stiffness.high - fit.stiffness.low));
    EXPECT_NEAR(drawn.parameters[0].high, fit.parameters[0].high, 0.2 * (fit.parameters[0].high - fit.parameters[0].low));
}

/// By brute force, errors of rows known from few degrees of freedom, so that the density has long tails.
TEST(Evidence, IsTheIntegralOverParameterAndStiffness) {
    constexpr int places = 81;
    const Experiment experiment = sweep_with_losses();
    DataSet data = data_set_of(experiment, {});
    for (Observation& one : data.observations) {
        one.errors.degrees = 5;
    }
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    for (const char* cause : {"tool-compliance", "contact-dashpot"}) {
        const Hypothesis hypothesis{find_mechanism(cause)};
        std::vector<double> logarithms;
        for (int place = 0; place < places; ++place) {
            const Model model = model_at(hypothesis, Eigen::VectorXd::Constant(1, (place + 0.5) / places), 1);
            logarithms.push_back(log_integral_over_stiffness(forward, errors, model));
        }
        const double integral = log_mean(logarithms) - log_prior_of_stiffness;
        EXPECT_NEAR(inference.fit(hypothesis).log_evidence, integral, 0.1) << cause;
    }
}

}  // namespace
}  // namespace coagula::diagnose
