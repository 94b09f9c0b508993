// SPDX-License-Identifier: GPL-3.0-or-later
// One instrument behind several tables, one sample behind several runs: a cause has one value for all of them.
#include "hidden_effects.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coagula::diagnose {
namespace {

constexpr double hidden_level = 4e5;  // G' [Pa]
constexpr double error = 0.01;
constexpr double inertia = 2e-4;  // kg.m2

/// G' against frequency under plates of this radius, with an inertia that nobody corrected.
Measurement sweep_under(double radius, double gap, std::uint64_t seed) {
    Measurement table;
    table.sample = "sample " + std::to_string(seed);
    table.label = table.sample;
    table.columns = {
        {"angular_frequency", "rad/s", {}}, {"plate_radius", "m", {}}, {"gap", "m", {}}, {"storage_modulus", "Pa", {}, {}}};
    for (std::uint64_t row = 0; row < 12; ++row) {
        const double frequency = std::pow(10, 0.2 * static_cast<double>(row));
        const double torque_per_modulus = std::numbers::pi * std::pow(radius, 4) / (2 * gap);
        const double shown = hidden_level - inertia * frequency * frequency / torque_per_modulus;
        const std::vector<double> cells{frequency, radius, gap, shown + error * hidden_level * drawn_normal(seed, row)};
        for (std::size_t column = 0; column < cells.size(); ++column) {
            table.columns[column].values.push_back(cells[column]);
        }
        table.columns.back().standard_errors.push_back(error * hidden_level);
    }
    return table;
}

/// G' at constant strain, which grows with the logarithm of the age since the first run.
Measurement aged_run(int order, double begin, double per_decade, std::uint64_t seed) {
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.sample = "gel";
    table.label = "run " + std::to_string(order);
    table.run_order = order;
    table.start = begin;
    table.columns = {{"time", "s", {}}, {"strain", "1", {}}, {"storage_modulus", "Pa", {}, {}}};
    for (std::uint64_t row = 0; row < 10; ++row) {
        const double time = 60.0 * static_cast<double>(row + 1);
        const double truth = hidden_level * (1 + per_decade * std::log10(1 + begin + time));
        table.columns[0].values.push_back(time);
        table.columns[1].values.push_back(1e-5);
        table.columns[2].values.push_back(truth * (1 + error * drawn_normal(seed, row)));
        table.columns[2].standard_errors.push_back(error * truth);
    }
    return table;
}

Diagnosis diagnosed(std::vector<Measurement> tables, const std::string& cause) {
    Experiment experiment;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 25e-3, .gap = 1e-3};
    experiment.measurements = std::move(tables);
    DiagnosisOptions options;
    options.bootstrap = 99;
    options.causes = {cause};
    return diagnose(experiment, simulator(), options);
}

const EstimatedParameter& parameter(const Diagnosis& found, const std::string& cause) {
    for (const Cause& one : found.causes) {
        if (one.name() == cause) {
            return one.parameters[1];
        }
    }
    throw std::runtime_error(cause + " is missing");
}

double width(const EstimatedParameter& one) {
    return std::log(one.high / one.low);
}

TEST(SharedParameters, OneInertiaUnderTwoPlates) {
    const Diagnosis one = diagnosed({sweep_under(12.5e-3, 0.5e-3, 1)}, "tool-inertia");
    const Diagnosis both = diagnosed({sweep_under(12.5e-3, 0.5e-3, 1), sweep_under(10e-3, 1e-3, 2)}, "tool-inertia");
    ASSERT_TRUE(one.detected && both.detected);
    const EstimatedParameter& found = parameter(both, "tool-inertia");
    EXPECT_NEAR(found.value, inertia, found.high - found.low);             // of 90 %: 3.3 standard deviations
    EXPECT_LT(width(found), 0.5 * width(parameter(one, "tool-inertia")));  // the smaller plate shows it 4.9 times as much
    EXPECT_GT(both.extended_p_value, 0.01);                                // one value serves both tables
}

TEST(SharedParameters, OneAgeingOverAllRunsOfASample) {
    constexpr double truth = 0.15;
    const Diagnosis found =
        diagnosed({aged_run(0, 0, truth, 3), aged_run(1, 7200, truth, 4), aged_run(2, 1e5, truth, 5)}, "ageing");
    ASSERT_TRUE(found.detected);
    const EstimatedParameter& rate = parameter(found, "ageing");
    EXPECT_LT(rate.low, truth);
    EXPECT_GT(rate.high, truth);
    EXPECT_LT(width(rate), 0.3);
    EXPECT_GT(found.extended_p_value, 0.01);
}

}  // namespace
}  // namespace coagula::diagnose
