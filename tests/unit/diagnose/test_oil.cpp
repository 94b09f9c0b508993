// SPDX-License-Identifier: GPL-3.0-or-later
// These tests hold what an oil of known viscosity shows, and which causes it tells apart.
#include "chain/forward.hpp"
#include "hidden_effects.hpp"
#include "infer/kinds.hpp"

#include <coagula/diagnose/mechanism.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::diagnose {
namespace {

/// A time sweep of G'' at 1 rad/s, one row a minute.
Measurement time_sweep(const std::string& sample, double gap) {
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.label = table.sample = sample;
    table.columns = {{"time", "s", {60, 120, 180, 240}},
                     {"angular_frequency", "rad/s", std::vector<double>(4, 1.0)},
                     {"gap", "m", std::vector<double>(4, gap)},
                     {"loss_modulus", "Pa", std::vector<double>(4, 2.0)}};
    return table;
}

Measurement oil() {
    Measurement table = time_sweep("oil", 1e-3);
    table.fluid_viscosity = 2;
    return table;
}

Experiment with(std::vector<Measurement> tables, MaterialKind kind) {
    Experiment experiment;
    experiment.material.kind = kind;
    experiment.measurements = std::move(tables);
    return experiment;
}

TEST(Oil, DriftsWithTheTemperatureAsTheSampleDoes) {
    const Experiment experiment = with({time_sweep("A", 1e-3), oil()}, MaterialKind::newtonian);
    const std::vector<Observation> observations = observations_of(experiment, {});
    const Forward forward(experiment, observations, simulator());
    constexpr double difference = -0.2;
    constexpr double settling = 300;
    const std::vector<double> values{difference, settling};
    const Model warming(Hypothesis{find_mechanism("temperature-drift")}, values, 2);
    const Eigen::VectorXd predicted = forward.predict(warming);
    ASSERT_EQ(observations.size(), 8);
    for (std::size_t k = 4; k < 8; ++k) {
        ASSERT_TRUE(is_fluid(observations[k]));
        EXPECT_NEAR(predicted[static_cast<Index>(k)], 2 * std::exp(difference * std::exp(-observations[k].time / settling)), 1e-12);
    }
}

TEST(Oil, AloneTellsADriftOfTheTemperatureFromWhatTheSampleDoes) {
    const Mechanism& drift = *find_mechanism("temperature-drift");
    const Mechanism& ageing = *find_mechanism("ageing");
    const Experiment gaps = with({time_sweep("A", 1e-3), time_sweep("B", 5e-4)}, MaterialKind::network);
    EXPECT_FALSE(is_separated(drift, gaps)) << "bubbles that shrink do the same at every gap";
    EXPECT_TRUE(is_separated(ageing, gaps));
    EXPECT_TRUE(is_separated(drift, with({time_sweep("A", 1e-3), oil()}, MaterialKind::network)));
}

/// The phase of an oil is not compared, and a delay of the electronics turns that of the sample as a dashpot does.
TEST(Oil, DoesNotTellALossFromAPhase) {
    const Experiment experiment = with({time_sweep("A", 1e-3), oil()}, MaterialKind::network);
    EXPECT_FALSE(is_separated(*find_mechanism("contact-dashpot"), experiment));
}

}  // namespace
}  // namespace coagula::diagnose
