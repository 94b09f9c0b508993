// SPDX-License-Identifier: GPL-3.0-or-later
// A structure that builds up after shear: its law, and whether it is told from what changes with strain.
#include "data/knows.hpp"
#include "hidden_effects.hpp"

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/mechanism.hpp>
#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {
namespace {

/// A run at constant small strain on a structure that the diagnosis does not know; stiffness grows as (1 + t / 20 s)^1.2.
Experiment build_up(bool sheared_before) {
    const Packing sample = structure(250, 77);
    mechanics::LinearOptions options;
    options.normal_stiffness = 2;
    options.shear_stiffness = 0.2;
    const double first = mechanics::solve_linear(sample, find_contacts(sample, 0.01), options).mean_shear_modulus();
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.sample = "paste";
    Column time{"time", "s", {}};
    Column strain{"strain", "1", {}};
    Column storage{"storage_modulus", "Pa", {}};
    for (int k = 1; k <= 24; ++k) {
        const double truth = first * std::pow(1 + 25.0 * k / 20, 1.2);
        time.values.push_back(25.0 * k);
        strain.values.push_back(5e-5);
        storage.standard_errors.push_back(0.03 * truth);
        storage.values.push_back(truth * (1 + 0.03 * drawn_normal(5, static_cast<std::uint64_t>(k))));
    }
    table.columns = {time, strain, storage};
    Experiment experiment;
    experiment.sample.sheared_before = sheared_before;
    experiment.measurements = {table};
    return experiment;
}

Diagnosis diagnosis_of(const Experiment& experiment) {
    static StoredSimulations stored("ageing_after_shear");
    static Simulator simulator({structure(200, 1)}, {"first"}, stored.results());
    DiagnosisOptions options;
    options.bootstrap = 199;
    return diagnose(experiment, simulator, options);
}

TEST(AgeingAfterShear, IsFoundWithItsExponent) {
    const Diagnosis found = diagnosis_of(build_up(true));
    EXPECT_TRUE(found.detected);
    const auto cause =
        std::find_if(found.causes.begin(), found.causes.end(), [](const Cause& one) { return one.name() == "ageing-after-shear"; });
    ASSERT_NE(cause, found.causes.end());
    const EstimatedParameter& exponent = cause->parameters[1];
    const double deviation = (exponent.high - exponent.low) / 3.29;  // of a 90 % interval
    EXPECT_LT(deviation, 0.05);
    EXPECT_NEAR(exponent.value, 1.2, 3 * deviation);
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_GT(found.extended_p_value, 0.01);
    EXPECT_GT(found.gain.rmse_ratio, 5);
    // What grows with the strain cannot explain a run at one strain, nor can the logarithm of an old gel explain a factor of fifty.
    for (const Cause& other : found.causes) {
        if (other.name() == "contact-nonlinearity" || other.name() == "bond-strength" || other.name() == "ageing") {
            EXPECT_GT(cause->log_evidence - other.log_evidence, 100) << other.name();
        }
    }
}

TEST(AgeingAfterShear, IsNoCauseWhereNothingWasSheared) {
    const Mechanism* mechanism = find_mechanism("ageing-after-shear");
    ASSERT_NE(mechanism, nullptr);
    EXPECT_FALSE(mechanism->applies(knowledge_of(build_up(false))));
    EXPECT_TRUE(mechanism->applies(knowledge_of(build_up(true))));
}

}  // namespace
}  // namespace coagula::diagnose
