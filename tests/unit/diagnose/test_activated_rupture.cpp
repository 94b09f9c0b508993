// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds that heat helps to break: the law against the rate equation behind it, and sweeps of other structures at two frequencies.
#include "chain/forward.hpp"
#include "data/knows.hpp"
#include "explicit_sweep.hpp"
#include "hidden_effects.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Strains up and down again, upwards in even steps of the logarithm.
std::vector<double> up_and_down() {
    std::vector<double> strains = logarithmic_steps(2e-5, 2.5e-3, 14);
    strains.insert(strains.end(), {8e-4, 2e-4, 5e-5});
    return strains;
}

Measurement sweep(double frequency, const std::vector<double>& strains, const std::vector<Complex>& moduli, double error,
                  std::uint64_t seed) {
    Measurement table;
    table.kind = MeasurementKind::amplitude_sweep;
    table.label = "hidden";
    table.sample = "at " + to_text(frequency) + " Hz";
    table.columns = {{"strain", "1", strains},
                     {"angular_frequency", "rad/s", std::vector<double>(strains.size(), 2 * pi * frequency)}};
    add_moduli(table, moduli, error, seed);
    return table;
}

/// Under a cone, where the strain is the same everywhere.
Experiment under_cone(const std::vector<Measurement>& tables) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::cone_plate, .plate_radius = 0.0125, .cone_angle = 0.03};
    experiment.measurements = tables;
    return experiment;
}

/// At a frequency where bonds are half as strong again, every strain does what two thirds of it do at 1 Hz.
TEST(ActivatedRupture, StretchesTheStrainsByTheLogarithmOfTheFrequency) {
    const std::vector<double> strains{1e-4, 2e-4, 4e-4, 7e-4, 3e-4};
    std::vector<double> shorter;
    for (const double strain : strains) {
        shorter.push_back(strain / 1.5);
    }
    const auto predicted = [&](double frequency, const std::vector<double>& at, double per_decade, bool exact) -> Eigen::VectorXd {
        const Experiment experiment = under_cone({sweep(frequency, at, std::vector<Complex>(at.size(), 1.0), 0, 1)});
        const auto rows = observations_of(experiment);
        const Model model({find_mechanism("activated-rupture")}, std::array{1e-4, per_decade});
        return Forward(experiment, rows, simulator()).predict(model, exact);
    };
    for (const bool exact : {false, true}) {
        const Eigen::VectorXd fast = predicted(100, strains, 0.25, exact);
        const Eigen::VectorXd slow = predicted(1, shorter, 0.25, exact);
        EXPECT_LT((fast - slow).norm(), 1e-9 * slow.norm()) << exact;
        EXPECT_GT((fast - predicted(1, strains, 0.25, exact)).norm(), 0.05 * slow.norm()) << exact;
    }
}

/// Two runs on one sample: what broke at a low frequency, where bonds are weaker, is gone at a high one.
TEST(ActivatedRupture, RemembersLoadsAndNotStrains) {
    const std::vector<double> strains{2e-4, 4e-4};
    const auto storage = [&](double first, double second) {
        std::vector<Measurement> runs{sweep(first, strains, {1.0, 1.0}, 0, 1), sweep(second, strains, {1.0, 1.0}, 0, 1)};
        runs[1].sample = runs[0].sample;
        runs[1].run_order = 1;
        const Experiment experiment = under_cone(runs);
        const auto rows = observations_of(experiment);
        const Model model({find_mechanism("activated-rupture")}, std::array{1e-4, 0.3});
        return Forward(experiment, rows, simulator()).predict(model).segment(4, 2).eval();
    };
    const Eigen::VectorXd after_slow = storage(0.1, 10);
    EXPECT_NEAR(after_slow[0], after_slow[1], 1e-9 * after_slow[1]);  // nothing more breaks
    const Eigen::VectorXd after_fast = storage(10, 0.1);
    EXPECT_GT(after_fast[0], 1.02 * after_fast[1]);
}

TEST(ActivatedRupture, NeedsSweepsOfStrainAtTwoFrequencies) {
    const std::vector<double> strains{1e-4, 1e-3};
    const Mechanism& cause = *find_mechanism("activated-rupture");
    const Measurement one = sweep(1, strains, {1.0, 1.0}, 0, 1);
    Measurement small = sweep(30, {1e-4, 1e-4}, {1.0, 1.0}, 0, 1);
    EXPECT_FALSE(cause.applies(knowledge_of(under_cone({one, small}))));
    EXPECT_TRUE(cause.applies(knowledge_of(under_cone({one, sweep(30, strains, {1.0, 1.0}, 0, 1)}))));
}

/// The force, over kT / x, that half of the bonds survive when it is reached in a quarter of an oscillation: those that are left
/// open at a rate that grows exponentially with the force on them (Bell 1978).
double median_rupture_force(double rate_at_rest, double frequency) {
    double low = 0.1;
    double high = 100;
    for (int step = 0; step < 60; ++step) {
        const double largest = 0.5 * (low + high);
        constexpr int parts = 4000;
        double opened = 0;
        for (int part = 0; part < parts; ++part) {
            const double phase = 0.5 * pi * (part + 0.5) / parts;
            opened += rate_at_rest * std::exp(largest * std::sin(phase)) / (4 * frequency * parts);
        }
        (opened < std::numbers::ln2 ? low : high) = largest;
    }
    return 0.5 * (low + high);
}

Diagnosis diagnosis_of(double first_strain, double second_strain) {
    const std::vector<double> strains = up_and_down();
    const auto slow = explicit_sweep(strains, first_strain, {77, 78}, {{2, 0}, {1, 2}});
    const auto fast = explicit_sweep(strains, second_strain, {77, 78}, {{2, 0}, {1, 2}});
    const Experiment measured = under_cone({sweep(0.1, strains, slow, 0.05, 3), sweep(10, strains, fast, 0.05, 4)});
    return diagnosis_with(399, measured);
}

TEST(ActivatedRupture, IsNamedFromSweepsAtTwoFrequencies) {
    constexpr double rate_at_rest = 1e-5;  // [1/s]
    const double unit = 3e-4 / median_rupture_force(rate_at_rest, 1);
    const double slow = unit * median_rupture_force(rate_at_rest, 0.1);
    const double fast = unit * median_rupture_force(rate_at_rest, 10);
    const Diagnosis found = diagnosis_of(slow, fast);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"activated-rupture"});
    ASSERT_EQ(found.causes.front().parameters.size(), 3U);
    const EstimatedParameter& growth = found.causes.front().parameters[2];
    const double truth = 0.5 * (fast - slow) / 3e-4;
    EXPECT_GT(truth, 0.1);
    EXPECT_LT(growth.low, truth);
    EXPECT_GT(growth.high, truth);
}

/// The same force at both frequencies is the simpler cause, which the other one only imitates.
TEST(ActivatedRupture, IsNotNamedWhereBondsBreakAtOneForce) {
    const Diagnosis found = diagnosis_of(3e-4, 3e-4);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.causes.front().name(), "bond-strength");
}

}  // namespace
}  // namespace coagula::diagnose
