// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds whose force grows faster than their extension: both harmonics of the stress, and whether they are found.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "data/knows.hpp"
#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <array>

namespace coagula::diagnose {
namespace {

using std::numbers::pi;

const Mechanism& stiffening() {
    return *find_mechanism("bond-stiffening");
}

/// Sine coefficient of a harmonic of the force of strands, over the amplitude: integral of one oscillation.
double coefficient(double amplitude, double stiffening_strain, double exponent, int harmonic) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double phase = 2 * pi * (k + 0.5) / steps;
        const double extension = amplitude * std::sin(phase);
        const double force = extension + std::copysign(stiffening_strain, extension) *
                                             std::pow(std::abs(extension) / stiffening_strain, 1 + exponent);
        sum += 2.0 / steps * force * std::sin(harmonic * phase);
    }
    return sum / amplitude;
}

Measurement sweep(const std::vector<double>& strains) {
    return {.kind = MeasurementKind::amplitude_sweep,
            .label = "hidden",
            .sample = "sample",
            .columns = {{"strain", "1", strains}, {"angular_frequency", "rad/s", std::vector<double>(strains.size(), 2 * pi)}},
            .left_out = {}};
}

TEST(BondStiffening, HasTheHarmonicsOfItsForce) {
    constexpr double strain = 0.03;
    Experiment experiment;
    experiment.measurements = {sweep({strain})};
    for (const char* seen : {"storage_modulus", "third_harmonic_storage"}) {
        experiment.measurements[0].columns.push_back({seen, "Pa", {1}});
    }
    const std::vector<Observation> rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const double small = forward.predict(Model{})[0];
    for (const double exponent : {1.5, 2.0, 3.0}) {
        const std::array values{0.02, exponent};
        const Eigen::VectorXd found = forward.predict(Model({&stiffening()}, values));
        const double first = coefficient(strain, values[0], exponent, 1);
        EXPECT_NEAR(found[0] / small, first, 1e-4 * first);
        EXPECT_NEAR(found[1], coefficient(strain, values[0], exponent, 3) / first, 1e-4);
    }
    const double square = std::pow(strain / 0.02, 2);
    EXPECT_NEAR(coefficient(strain, 0.02, 2, 1), 1 + 0.75 * square, 1e-9);
    EXPECT_NEAR(coefficient(strain, 0.02, 2, 3), -0.25 * square, 1e-9);
}

/// At one strain alone the cause is a level, which other causes can be, too: it needs two.
TEST(BondStiffening, IsNoCauseAtOneStrain) {
    Experiment experiment;
    experiment.measurements = {sweep({1e-3, 1e-2})};
    EXPECT_TRUE(stiffening().applies(knowledge_of(experiment)));
    experiment.measurements = {sweep({1e-3, 1e-3})};
    EXPECT_FALSE(stiffening().applies(knowledge_of(experiment)));
}

/// A sweep of strains up and down again, of bonds with a cubic force.
Diagnosis of_taut_strands(double stiffening_strain, double error = 0.03) {
    std::vector<double> strains = logarithmic_steps(1e-3, 0.05, 16);
    strains.insert(strains.end(), strains.rbegin(), strains.rend());
    std::vector<std::complex<double>> moduli;
    for (const double strain : strains) {
        moduli.emplace_back(2e4 * coefficient(strain, stiffening_strain, 2, 1), 0);
    }
    Experiment experiment;
    experiment.measurements = {sweep(strains)};
    add_moduli(experiment.measurements[0], moduli, error, 7);
    return diagnosis_with(399, experiment);
}

TEST(BondStiffening, IsNamedWhereItComesBackOnTheWayDown) {
    const Diagnosis found = of_taut_strands(0.04);
    EXPECT_EQ(found.verdict, Verdict::named) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"bond-stiffening"});
    const std::vector<EstimatedParameter>& parameters = found.causes.front().parameters;
    const auto holds = [](const EstimatedParameter& one, double truth) {
        const double half = 0.5 * (one.high - one.low);
        EXPECT_NEAR(0.5 * (one.low + one.high), truth, 2 * half) << one.name;
        EXPECT_LT(half, 0.2 * truth) << one.name;
    };
    holds(parameters[1], 0.04);
    holds(parameters[2], 2);
    EXPECT_GT(found.gain.rmse_ratio, 2);
}

bool beats_readings(const Diagnosis& found) {
    const auto condition = std::find_if(found.conditions.begin(), found.conditions.end(),
                                        [](const Condition& one) { return one.name == "beats-readings"; });
    return condition->holds;
}

/// Under one plate a torque that is read by some hundredths too large where it is large does the same; more is no error of reading.
TEST(BondStiffening, IsNotToldFromATorqueThatIsNotReadInProportion) {
    const Diagnosis small = of_taut_strands(0.15, 0.01);
    EXPECT_EQ(small.verdict, Verdict::tied);
    EXPECT_FALSE(beats_readings(small));
    EXPECT_FALSE(small.follows.link_is_told);
    const std::vector<std::string> names = names_of(small.credible_set);
    EXPECT_NE(std::find(names.begin(), names.end(), "none of the catalogue"), names.end());
    const Diagnosis large = of_taut_strands(0.04);
    EXPECT_TRUE(beats_readings(large));
    EXPECT_TRUE(large.follows.link_is_told);
}

}  // namespace
}  // namespace coagula::diagnose
