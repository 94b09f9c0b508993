// SPDX-License-Identifier: GPL-3.0-or-later
// What a planned experiment is said to find is held against diagnoses of data that another code path makes.
#include <coagula/diagnose/power.hpp>
#include <coagula/mechanics/frequency.hpp>

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {
namespace {

using std::numbers::pi;

const Packing& known_structure() {
    static const Packing made = structure(200, 1);
    return made;
}

Simulator& known_simulator() {
    static StoredSimulations stored("one_structure");
    static Simulator made({known_structure()}, {"one"}, stored.results());
    return made;
}

std::vector<double> frequencies() {
    return logarithmic_steps(0.1, 100, 16);
}

/// A frequency sweep that somebody plans.
Experiment planned() {
    Measurement table;
    table.label = "planned";
    table.sample = "sample";
    std::vector<double> angular = frequencies();
    std::for_each(angular.begin(), angular.end(), [](double& value) { value *= 2 * pi; });
    table.columns = {{"angular_frequency", "rad/s", angular}};
    Experiment experiment;
    experiment.measurements = {table};
    return experiment;
}

PowerOptions options_for(const std::string& cause) {
    PowerOptions options;
    options.causes = {cause};
    options.noise.relative = 0.03;
    options.diagnosis.bootstrap = 199;
    options.diagnoses = 0;
    return options;
}

/// Measured moduli with errors and the effect of a sample.
Experiment measured(const mechanics::FrequencyResponse& truth, const StatedNoise& noise, std::uint64_t seed) {
    const double sample = 1 + noise.sample * drawn_normal(seed, 1000, 11);
    Column storage{"storage_modulus", "Pa", {}, {}};
    Column loss{"loss_modulus", "Pa", {}, {}};
    for (std::size_t k = 0; k < truth.points.size(); ++k) {
        const std::complex<double> modulus = sample * truth.points[k].mean_shear_modulus();
        storage.standard_errors.push_back(noise.relative * modulus.real());
        loss.standard_errors.push_back(std::hypot(noise.relative * modulus.imag(), noise.phase * std::abs(modulus)));
        storage.values.push_back(modulus.real() + storage.standard_errors[k] * drawn_normal(seed, 2 * k, 11));
        loss.values.push_back(modulus.imag() + loss.standard_errors[k] * drawn_normal(seed, 2 * k + 1, 11));
    }
    Experiment experiment = planned();
    experiment.measurements[0].columns.push_back(storage);
    experiment.measurements[0].columns.push_back(loss);
    return experiment;
}

/// Share of data sets from the frequency solver, contacts with a springpot, in which a diagnosis finds something.
double found_share(const PowerOptions& options, double springpot_over_spring, double exponent, int data_sets) {
    ContactModel model{.normal_stiffness = 100, .shear_stiffness = 10};
    model.normal_springpot_stiffness = springpot_over_spring * 50;
    model.shear_springpot_stiffness = springpot_over_spring * 5;
    model.normal_springpot_time = model.shear_springpot_time = 1 / (2 * pi);
    model.normal_springpot_exponent = model.shear_springpot_exponent = exponent;
    const auto truth =
        mechanics::solve_frequency_sweep(known_structure(), find_contacts(known_structure(), 0.01), model, frequencies());
    DiagnosisOptions diagnosis = options.diagnosis;
    diagnosis.errors.sample = options.noise.sample;
    diagnosis.level = 0;  // nothing is asked but the p-value of the base model
    int found = 0;
    for (int set = 1; set <= data_sets; ++set) {
        diagnosis.seed = static_cast<std::uint64_t>(set);
        const Experiment experiment = measured(truth, options.noise, diagnosis.seed);
        found += diagnose(experiment, known_simulator(), diagnosis).p_value <= options.diagnosis.level ? 1 : 0;
    }
    return static_cast<double>(found) / data_sets;
}

TEST(Power, AgreesWithDiagnosesOfDataMadeInAnotherWay) {
    PowerOptions options = options_for("contact-loss");
    options.noise.phase = 0.02;  // with less, losses at the lower end of the prior are found more often than not
    const Power power = find_power(planned(), known_simulator(), options);
    ASSERT_EQ(power.causes.size(), 1U);
    const CausePower& loss = power.causes.front();
    EXPECT_EQ(loss.parameter, "springpot_over_spring");
    ASSERT_TRUE(std::isfinite(loss.half.value) && std::isfinite(loss.most.value));
    EXPECT_LT(loss.half.low, loss.half.value);
    EXPECT_LT(loss.half.value, loss.half.high);
    EXPECT_LT(loss.half.value, loss.most.value);
    constexpr int data_sets = 200;
    const double exponent = loss.others.at("exponent");
    // Four standard deviations of the count, and of the threshold itself.
    EXPECT_NEAR(found_share(options, loss.half.value, exponent, data_sets), 0.5, 0.2);
    EXPECT_NEAR(found_share(options, loss.most.value, exponent, data_sets), 0.95, 0.08);
    EXPECT_LT(found_share(options, loss.half.value / 3, exponent, data_sets), 0.25);
    EXPECT_EQ(power.by_chance.of, options.data_sets);
    EXPECT_NEAR(static_cast<double>(power.by_chance.count) / power.by_chance.of, 0.05,
                4 * std::sqrt(0.05 * 0.95 / options.data_sets));
}

TEST(Power, SaysWhenNothingCanBeFound) {
    // One structure and a free stiffness: what scales all moduli alike leaves no trace.
    const Power power = find_power(planned(), known_simulator(), options_for("bond-bending"));
    ASSERT_EQ(power.causes.size(), 1U);
    const CausePower& bending = power.causes.front();
    EXPECT_TRUE(std::isnan(bending.half.value));
    EXPECT_TRUE(std::isnan(bending.most.value));
    EXPECT_LT(bending.curve.back().found.count, 0.15 * bending.curve.back().found.of);
    EXPECT_EQ(bending.naming.runs, 0);
}

TEST(Power, FindsWeakerCausesWithLessNoise) {
    PowerOptions options = options_for("tool-inertia");
    Experiment experiment = planned();
    experiment.instrument.geometry = Geometry::plate_plate;
    experiment.instrument.plate_radius = 0.0125;
    experiment.instrument.gap = 1e-3;
    const double noisy = find_power(experiment, known_simulator(), options).causes.front().half.value;
    options.noise.relative = 0.015;
    const double clean = find_power(experiment, known_simulator(), options).causes.front().half.value;
    EXPECT_NEAR(noisy / clean, 2, 0.4);  // the size of a linear effect that is found goes with the noise
}

/// An upward amplitude sweep on one sample, with its waveforms.
Experiment planned_sweep(bool waveforms) {
    Experiment experiment;
    Measurement sweep;
    sweep.kind = MeasurementKind::amplitude_sweep;
    sweep.label = "sweep";
    sweep.sample = "sample";
    const std::vector<double> strains = logarithmic_steps(1e-5, 1e-2, 10);
    sweep.columns = {{"strain", "1", strains}};
    experiment.measurements = {sweep};
    if (waveforms) {
        sweep.kind = MeasurementKind::harmonics;
        experiment.measurements.push_back(sweep);
    }
    return experiment;
}

TEST(Power, OfWaveforms) {
    PowerOptions options = options_for("contact-nonlinearity");
    options.noise.relative = 0.1;
    options.noise.phase = 0.1;
    options.data_sets = 100;
    const Power moduli = find_power(planned_sweep(false), known_simulator(), options);
    const Power both = find_power(planned_sweep(true), known_simulator(), options);
    EXPECT_EQ(moduli.moduli, 20U);
    EXPECT_EQ(moduli.third_harmonics, 0U);
    EXPECT_EQ(both.moduli, 20U);
    EXPECT_EQ(both.third_harmonics, 20U);
    EXPECT_LE(both.by_chance.count, 13);  // 5 + 4 sqrt(5 * 0.95)
    // A third harmonic of up to a ninth is seen in errors of 0.005 where the moduli are lost in 10 %: contacts may be loaded more.
    EXPECT_GT(both.causes.front().half.value, 1.5 * moduli.causes.front().half.value);
}

TEST(Power, NamingRunsAddUp) {
    PowerOptions options = options_for("ageing");
    options.data_sets = 40;
    options.diagnoses = 3;
    const NamingRuns naming = find_power(planned(), known_simulator(), options).causes.front().naming;
    EXPECT_EQ(naming.runs, 3);
    EXPECT_EQ(naming.named + naming.tied + naming.misnamed + naming.none + naming.missed, 3);
    EXPECT_GE(naming.named + naming.tied, 2);
}

TEST(Power, RefusesWhatPlansNothing) {
    Experiment experiment = planned();
    EXPECT_THROW(find_power(experiment, known_simulator(), options_for("magic")), InputError);
    experiment.measurements[0].kind = MeasurementKind::coordinates;
    EXPECT_THROW(find_power(experiment, known_simulator(), options_for("ageing")), InputError);
    experiment = planned_sweep(true);
    experiment.measurements.erase(experiment.measurements.begin());  // third harmonics alone
    EXPECT_THROW(find_power(experiment, known_simulator(), options_for("contact-nonlinearity")), InputError);
}

TEST(Share, HasTheIntervalOfWilson) {
    const Share share = share_of(10, 100);
    // Roots p of (p - 0.1)^2 = z^2 p (1 - p) / 100, the definition.
    for (const double end : {share.low, share.high}) {
        EXPECT_NEAR(std::pow(end - 0.1, 2), std::pow(1.959964, 2) * end * (1 - end) / 100, 1e-12);
    }
    EXPECT_LT(share.low, 0.1);
    EXPECT_GT(share.high, 0.1);
    EXPECT_EQ(share_of(0, 20).low, 0);
    EXPECT_EQ(share_of(20, 20).high, 1);
}

}  // namespace
}  // namespace coagula::diagnose
