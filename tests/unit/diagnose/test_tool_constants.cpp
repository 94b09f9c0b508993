// SPDX-License-Identifier: GPL-3.0-or-later
// Torque, deflection and raw phase as moduli.
#include <coagula/diagnose/check_data.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

Instrument plates() {
    return {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
}

Instrument cylinders() {
    return {.geometry = Geometry::concentric_cylinders, .inner_radius = 0.0133, .outer_radius = 0.0145, .bob_length = 0.04};
}

/// Torque of a Newtonian fluid between cylinders over its viscosity and the angular velocity, exactly (Couette).
TEST(ToolConstants, OfCylindersAreThoseOfANewtonianFluid) {
    const Instrument tool = cylinders();
    const double inner = tool.inner_radius * tool.inner_radius;
    const double outer = tool.outer_radius * tool.outer_radius;
    EXPECT_NEAR(tool_constants(tool).torque_per_modulus() / (4 * pi * tool.bob_length * inner * outer / (outer - inner)), 1, 1e-12);
    Instrument corrected = tool;
    corrected.end_correction = 1.1;
    EXPECT_NEAR(tool_constants(corrected).torque_per_modulus() / tool_constants(tool).torque_per_modulus(), 1.1, 1e-12);
}

TEST(ToolConstants, OfPlatesAndConeAreThoseOfTheTextbook) {
    EXPECT_NEAR(tool_constants(plates()).torque_per_modulus(), pi * std::pow(0.0125, 4) / 2e-3, 1e-18);
    const Instrument cone{.geometry = Geometry::cone_plate, .plate_radius = 0.02, .cone_angle = 0.0175};
    EXPECT_NEAR(tool_constants(cone).torque_per_modulus(), 2 * pi * 8e-6 / (3 * 0.0175), 1e-15);
    EXPECT_NEAR(tool_constants(plates(), 0.5e-3, unset, unset).strain, 25, 1e-12);  // the gap of a row
    Instrument stated = plates();
    stated.stress_constant = 1e5;
    stated.strain_constant = 10;
    EXPECT_EQ(tool_constants(stated).torque_per_modulus(), 1e-4);
    EXPECT_NEAR(tool_constants(stated, 0.5e-3, unset, unset).strain, 25, 1e-12);
    stated.plate_radius = unset;  // a column of the gap alone does not undo what is stated
    EXPECT_EQ(tool_constants(stated, 0.5e-3, unset, unset).torque_per_modulus(), 1e-4);
    EXPECT_TRUE(std::isnan(tool_constants(Instrument{}).torque_per_modulus()));
}

/// What such a tool reads of these moduli at a deflection of 1 mrad, its own inertia included.
Measurement read_by(const Instrument& tool, const std::vector<double>& frequencies, const std::vector<Complex>& moduli,
                    double inertia) {
    Measurement table;
    table.label = table.sample = "raw";
    table.columns = {
        {"angular_frequency", "rad/s", frequencies}, {"torque", "N.m", {}}, {"deflection", "rad", {}}, {"raw_phase", "rad", {}}};
    for (std::size_t row = 0; row < frequencies.size(); ++row) {
        const Complex torque =
            1e-3 * (tool_constants(tool).torque_per_modulus() * moduli[row] - inertia * frequencies[row] * frequencies[row]);
        table.columns[1].values.push_back(std::abs(torque));
        table.columns[2].values.push_back(1e-3);
        table.columns[3].values.push_back(std::arg(torque));
    }
    return table;
}

TEST(RawModuli, AreWhatTorqueAndDeflectionSay) {
    for (const Instrument& tool : {plates(), cylinders()}) {
        Measurement table = read_by(tool, {1, 10, 100}, {{1e5, 1e3}, {1.1e5, 2e3}, {1.2e5, 4e3}}, 1e-5);
        derive_moduli(table, tool, false);
        const Column* storage = find_column(table, "storage_modulus");
        const Column* loss = find_column(table, "loss_modulus");
        ASSERT_TRUE(storage != nullptr && loss != nullptr);
        for (std::size_t row = 0; row < 3; ++row) {
            const double frequency = std::pow(10.0, static_cast<double>(row));
            const double shift = 1e-5 * frequency * frequency / tool_constants(tool).torque_per_modulus();
            EXPECT_NEAR(storage->values[row], 1e5 + 1e4 * static_cast<double>(row) - shift, 1e-6 * 1e5);
            EXPECT_NEAR(loss->values[row], 1e3 * std::pow(2.0, static_cast<double>(row)), 1e-6 * 1e5);
        }
        EXPECT_NEAR(find_column(table, "strain")->values[0], 1e-3 * tool_constants(tool).strain, 1e-12);
    }
}

TEST(RawModuli, TakeThePlaceOfCorrectedOnesWhereTheyAreWanted) {
    const Measurement raw = read_by(plates(), {1, 100}, {{1e5, 0}, {1e5, 0}}, 1e-5);
    Measurement both = raw;
    both.columns.push_back({"storage_modulus", "Pa", {1e5, 1e5}});
    both.columns.push_back({"loss_modulus", "Pa", {0, 0}});
    Measurement as_given = both;
    derive_moduli(as_given, plates(), false);
    EXPECT_EQ(find_column(as_given, "storage_modulus")->values[1], 1e5);
    derive_moduli(both, plates(), true);
    EXPECT_NEAR(find_column(both, "storage_modulus")->values[1], 1e5 - 0.1 / tool_constants(plates()).torque_per_modulus(), 1e-3);
}

TEST(RawModuli, AreRefusedWithoutTheSizeOfTheTool) {
    Measurement table = read_by(plates(), {1, 10}, {{1e5, 1e3}, {1e5, 1e3}}, 0);
    EXPECT_THROW(derive_moduli(table, {}, false), InputError);
    Measurement lacking = table;
    lacking.columns.erase(lacking.columns.begin() + 2);
    EXPECT_THROW(derive_moduli(lacking, plates(), true), InputError);
}

TEST(RawModuli, OfARowThatDidNotMoveOrHasNoPhaseAreLeftOut) {
    Measurement table = read_by(plates(), {1, 10, 100}, {{1e5, 1e3}, {1e5, 1e3}, {1e5, 1e3}}, 0);
    table.columns[2].values[1] = 0;
    table.columns[3].values[0] = 9;  // rad
    derive_moduli(table, plates(), false);
    for (const char* name : {"storage_modulus", "loss_modulus"}) {
        EXPECT_TRUE(std::isnan(find_column(table, name)->values[0])) << name;
        EXPECT_TRUE(std::isnan(find_column(table, name)->values[1])) << name;
    }
    EXPECT_NEAR(find_column(table, "storage_modulus")->values[2], 1e5, 1e-3);
    ASSERT_EQ(table.left_out.size(), 1U);
    EXPECT_EQ(table.left_out[0].column, "deflection");
    EXPECT_EQ(table.left_out[0].row, 1U);
}

TEST(RawModuli, OfStressAndStrainOrOfOneModulusAndItsPhase) {
    Measurement table;
    table.columns = {{"strain", "1", {0.01, 0.02}}, {"stress", "Pa", {10, 10}}, {"phase", "rad", {0.5, 1.5}}};
    derive_moduli(table, {}, false);
    EXPECT_NEAR(find_column(table, "storage_modulus")->values[0], 1000 * std::cos(0.5), 1e-9);
    EXPECT_NEAR(find_column(table, "loss_modulus")->values[1], 500 * std::sin(1.5), 1e-9);
    Measurement polar;
    polar.columns = {{"strain", "1", {0.01}}, {"complex_modulus", "Pa", {200}}, {"loss_tangent", "1", {0.1}}};
    derive_moduli(polar, {}, false);
    EXPECT_NEAR(find_column(polar, "loss_modulus")->values[0] / find_column(polar, "storage_modulus")->values[0], 0.1, 1e-12);
}

/// The torque of a heavy tool contradicts moduli that were corrected for its inertia: the moduli stay.
TEST(RawModuli, ATorqueThatTurnsTheToolAccusesNoModulus) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 12);
    Measurement table = read_by(plates(), frequencies, std::vector<Complex>(12, {1e5, 1e4}), 2e-5);
    std::erase_if(table.columns, [](const Column& column) { return column.name == "raw_phase"; });
    table.columns.push_back({"strain", "1", std::vector<double>(12, 0.0125)});
    table.columns.push_back({"storage_modulus", "Pa", std::vector<double>(12, 1e5)});
    table.columns.push_back({"loss_modulus", "Pa", std::vector<double>(12, 1e4)});
    table.columns.back().values[3] *= 1.001;
    table.columns[5].values[3] *= 1.001;
    const CheckedMeasurement checked = check_data(table);
    EXPECT_FALSE(checked.measurement.left_out.empty());
    for (const LeftOutCell& cell : checked.measurement.left_out) {
        EXPECT_EQ(cell.column, "torque") << cell.reason;
    }
}

/// Torque and phase of a network under a heavy tool, its inertia so large that G' falls below zero.
TEST(RawModuli, ShowTheInertiaOfTheTool) {
    const std::vector<double> frequencies = logarithmic_steps(1, 600, 16);
    const double stiffness = tool_constants(plates()).torque_per_modulus();
    constexpr double inertia = 4e-5;
    Experiment experiment;
    experiment.instrument = plates();
    std::uint64_t seed = 30;
    for (const char* sample : {"A", "B", "C"}) {
        Measurement table =
            read_by(plates(), frequencies, std::vector<Complex>(16, {1e5 * (1 + 0.02 * drawn_normal(++seed, 0)), 0}), inertia);
        table.label = table.sample = sample;
        for (std::size_t row = 0; row < 16; ++row) {
            table.columns[1].values[row] *= 1 + 0.02 * drawn_normal(seed, 2 * row + 1);
            table.columns[3].values[row] += 0.004 * drawn_normal(seed, 2 * row + 2);
        }
        derive_moduli(table, experiment.instrument, false);
        experiment.measurements.push_back(table);
    }
    ASSERT_LT(find_column(experiment.measurements[0], "storage_modulus")->values[15], 0);
    ASSERT_GT(inertia * 600 * 600 / stiffness, 1e5);
    DiagnosisOptions options;
    options.errors = estimated_errors(experiment, noise_of_tables(experiment.measurements));
    options.bootstrap = 399;
    const Diagnosis found = diagnose(experiment, simulator(), options);
    EXPECT_EQ(found.verdict, Verdict::named);
    ASSERT_EQ(names_of(found.credible_set), std::vector<std::string>{"tool-inertia"});
    const EstimatedParameter& estimate = found.causes.front().parameters[1];
    EXPECT_LT(estimate.low, inertia);
    EXPECT_GT(estimate.high, inertia);
    EXPECT_LT(estimate.high / estimate.low, 1.2);
}

}  // namespace
}  // namespace coagula::diagnose
