// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/outliers.hpp>

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// A sweep in strain with a yield, errors of 2 % and a level of its own.
Measurement sweep_of(const std::string& sample, double level, std::uint64_t seed) {
    Measurement table;
    table.kind = MeasurementKind::amplitude_sweep;
    table.label = "sweep of " + sample;
    table.sample = sample;
    table.columns = {{"strain", "1", {}}, {"storage_modulus", "Pa", {}}, {"loss_modulus", "Pa", {}}};
    for (std::uint64_t row = 0; row < 14; ++row) {
        const double strain = 1e-5 * std::pow(2, row);
        const double left = 1 / (1 + std::pow(strain / 0.01, 2));
        table.columns[0].values.push_back(strain);
        table.columns[1].values.push_back(level * left * (1 + 0.02 * drawn_normal(seed, 2 * row)));
        table.columns[2].values.push_back(0.1 * level * (1 + 0.02 * drawn_normal(seed, 2 * row + 1)));
    }
    return table;
}

std::vector<Measurement> three_samples() {
    return {sweep_of("A", 1e5, 1), sweep_of("B", 1.08e5, 2), sweep_of("C", 0.94e5, 3)};
}

void multiply(Measurement& table, std::size_t row, double factor) {
    table.columns[1].values[row] *= factor;
    table.columns[2].values[row] *= factor;
}

TEST(Outliers, FindNothingInErrorsAndSamplesAsUsual) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        std::vector<Measurement> tables{sweep_of("A", 1e5, 10 + 3 * seed), sweep_of("B", 1.15e5, 11 + 3 * seed),
                                        sweep_of("C", 0.9e5, 12 + 3 * seed)};
        EXPECT_TRUE(leave_out_outliers(tables).empty()) << seed;
        std::vector<Measurement> alone{tables.front()};
        EXPECT_TRUE(leave_out_outliers(alone).empty()) << seed;
    }
}

TEST(Outliers, AreRowsBesideTheirNeighboursAndTheOtherSamples) {
    std::vector<Measurement> tables = three_samples();
    multiply(tables[1], 4, 10);
    multiply(tables[1], 11, 0.1);
    const std::vector<Outlier> found = leave_out_outliers(tables);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].measurement, 1U);
    EXPECT_EQ(found[0].row, 4U);
    EXPECT_NEAR(found[0].factor, 10, 1);
    EXPECT_EQ(found[1].measurement, 1U);
    EXPECT_EQ(found[1].row, 11U);
    EXPECT_TRUE(std::isnan(tables[1].columns[1].values[4]));
    EXPECT_TRUE(std::isnan(tables[1].columns[2].values[4]));
    ASSERT_EQ(tables[1].left_out.size(), 4U);
    EXPECT_NE(tables[1].left_out[0].reason.find("outlier"), std::string::npos);
    EXPECT_TRUE(std::isfinite(tables[0].columns[1].values[4]));
}

/// At an end there is one neighbour: only the other samples tell.
/// Runs on one sample leave no others to compare it with.
TEST(Outliers, AreNoSamplesWhereThereIsOne) {
    std::vector<Measurement> runs = {sweep_of("A", 1e5, 1), sweep_of("A", 0.3e5, 2), sweep_of("A", 2e5, 3)};
    for (std::size_t run = 0; run < runs.size(); ++run) {
        runs[run].label += std::to_string(run);
    }
    for (const Outlier& outlier : leave_out_outliers(runs)) {
        EXPECT_TRUE(outlier.row) << outlier.measurement;
    }
    std::vector<Measurement> alone = {sweep_of("A", 1e5, 1)};
    EXPECT_TRUE(leave_out_outliers(alone).empty());
}

TEST(Outliers, AtAnEndAreToldByTheOtherSamples) {
    std::vector<Measurement> tables = three_samples();
    multiply(tables[0], 13, 10);
    const std::vector<Outlier> found = leave_out_outliers(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].row, 13U);
    std::vector<Measurement> alone{three_samples()[0]};
    multiply(alone[0], 13, 10);
    EXPECT_TRUE(leave_out_outliers(alone).empty());
}

/// Before the first row the sample had no time to change: of a single table, and of two, it is told by the course of the next rows.
TEST(Outliers, AtTheBeginningAreToldByTheNextRows) {
    std::vector<Measurement> alone{three_samples()[0]};
    multiply(alone[0], 0, 10);
    const std::vector<Outlier> found = leave_out_outliers(alone);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].row, 0U);
    EXPECT_NEAR(found[0].factor, 10, 1);
    std::vector<Measurement> two{three_samples()[0], three_samples()[1]};
    multiply(two[1], 0, 10);
    EXPECT_EQ(leave_out_outliers(two).size(), 1U);
    // A sample that still builds up.
    std::vector<Measurement> low{three_samples()[0]};
    multiply(low[0], 0, 0.1);
    EXPECT_TRUE(leave_out_outliers(low).empty());
    // A relaxation that begins fast, and rows against the order of time.
    std::vector<Measurement> relaxing{three_samples()[0]};
    for (std::size_t row = 0; row < 14; ++row) {
        multiply(relaxing[0], row, 1 + 9 * std::exp(-0.8 * static_cast<double>(row)));
    }
    EXPECT_TRUE(leave_out_outliers(relaxing).empty());
    std::vector<Measurement> reversed{three_samples()[0]};
    multiply(reversed[0], 0, 10);
    reversed[0].columns.push_back({"time", "s", {}});
    for (std::size_t row = 0; row < 14; ++row) {
        reversed[0].columns.back().values.push_back(140 - 10 * static_cast<double>(row));
    }
    EXPECT_TRUE(leave_out_outliers(reversed).empty());
}

/// What every sample shows in a row is no outlier, nor is a step, after which all is different.
TEST(Outliers, AreNeitherPeaksThatAllSamplesHaveNorSteps) {
    std::vector<Measurement> tables = three_samples();
    for (Measurement& table : tables) {
        multiply(table, 5, 3);
    }
    EXPECT_TRUE(leave_out_outliers(tables).empty());
    std::vector<Measurement> stepped{sweep_of("A", 1e5, 7)};
    for (std::size_t row = 6; row < 14; ++row) {
        multiply(stepped[0], row, 0.3);
    }
    EXPECT_TRUE(leave_out_outliers(stepped).empty());
}

TEST(Outliers, AreNoRowsWhereInertiaCancelsTheElasticity) {
    for (const double inertia : {0.2, 0.5, 0.8}) {  // of 1e5 Pa at row 12
        Measurement table = sweep_of("A", 1e5, 1);
        for (std::size_t row = 0; row < 14; ++row) {
            table.columns[1].values[row] = 1e5 * (1 - inertia * std::pow(2.5, static_cast<double>(row) - 11));
            table.columns[2].values[row] = 1e3;
        }
        std::vector<Measurement> tables{table};
        EXPECT_TRUE(leave_out_outliers(tables).empty()) << inertia;
    }
}

TEST(Outliers, AreSamplesThatLieFarBesideTwoOthers) {
    std::vector<Measurement> tables = three_samples();
    for (std::size_t row = 0; row < 14; ++row) {
        multiply(tables[1], row, 0.4);
    }
    const std::vector<Outlier> found = leave_out_outliers(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].measurement, 1U);
    EXPECT_FALSE(found[0].row.has_value());
    EXPECT_NEAR(found[0].factor, 0.43, 0.03);
    EXPECT_EQ(tables[found[0].measurement].sample, "B");
    // Of two nobody knows which.
    std::vector<Measurement> two{three_samples()[0], three_samples()[1]};
    for (std::size_t row = 0; row < 14; ++row) {
        multiply(two[1], row, 0.4);
    }
    EXPECT_TRUE(leave_out_outliers(two).empty());
}

}  // namespace
}  // namespace coagula::diagnose
