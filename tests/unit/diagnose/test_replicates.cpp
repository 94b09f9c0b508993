// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>

#include "example_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace coagula::diagnose {
namespace {

Measurement sweep_of(const std::string& sample) {
    Measurement table = amplitude_sweep();
    table.sample = sample;
    return table;
}

TEST(Replicates, AreTablesWithOneAxis) {
    Measurement second = sweep_of("B");
    for (double& strain : column(second, "strain").values) {
        strain *= 1.005;
    }
    for (const char* name : {"storage_modulus", "loss_modulus"}) {
        for (double& modulus : column(second, name).values) {
            modulus *= 0.7;
        }
    }
    const std::vector<Replicates> found = find_replicates({sweep_of("A"), second});
    ASSERT_EQ(found.size(), 2U);  // of torque and phase
    EXPECT_EQ(found[0].observable, "complex_modulus");
    EXPECT_EQ(found[1].observable, "phase");
    EXPECT_EQ(found[0].samples, (std::vector<std::string>{"A", "B"}));
    EXPECT_TRUE(found[0].floor_of_stress);
    for (Eigen::Index row = 0; row < found[0].values.rows(); ++row) {
        EXPECT_DOUBLE_EQ(found[0].values(row, 1), 0.7 * found[0].values(row, 0));
        EXPECT_NEAR(found[1].values(row, 1), 0, 1e-9 * found[1].levels[row]);  // the phase is the same
        EXPECT_DOUBLE_EQ(found[0].floor_weights[row], 1 / found[0].axis[row]);
    }
}

TEST(Replicates, DifferInFrequencyOrKindThenTheyAreNone) {
    Measurement faster = sweep_of("B");
    for (double& frequency : column(faster, "angular_frequency").values) {
        frequency *= 2;
    }
    EXPECT_EQ(find_replicates({sweep_of("A"), faster}).size(), 4U);
    Measurement wave = sweep_of("C");
    wave.kind = MeasurementKind::structure_series;
    EXPECT_TRUE(find_replicates({wave}).empty());
}

TEST(Replicates, LineUpWhereRowsWereLeftOut) {
    Measurement second = sweep_of("B");
    column(second, "strain").values[4] = unset;
    column(second, "storage_modulus").values[7] = unset;
    const Replicates found = find_replicates({sweep_of("A"), second}).front();
    EXPECT_TRUE(std::isnan(found.values(4, 1)));
    EXPECT_TRUE(std::isnan(found.values(7, 1)));
    EXPECT_EQ(found.values(8, 0), found.values(8, 1));
}

/// Values of the second table beside those of the first, whose storage moduli are 100, 101, ... in its rows.
TEST(Replicates, LineUpByTheNearestRowThatIsAlike) {
    Measurement first = sweep_of("A");
    Measurement second = sweep_of("B");
    for (Measurement* table : {&first, &second}) {
        std::erase_if(table->columns, [](const Column& one) { return one.name == "loss_modulus"; });
    }
    const std::size_t rows = first.rows();
    ASSERT_GE(rows, 10U);
    for (std::size_t row = 0; row < rows; ++row) {
        column(second, "storage_modulus").values[row] = 100 + static_cast<double>(row);
        column(second, "strain").values[row] = column(first, "strain").values[row];
    }
    std::vector<double>& strain = column(second, "strain").values;
    const std::vector<double>& wanted = column(first, "strain").values;
    strain[0] = 0.99 * wanted[0];   // below it
    strain[1] = 0.998 * wanted[1];  // two rows for one: the lower is nearer
    strain[2] = 1.015 * wanted[1];
    strain[3] = 0.985 * wanted[4];  // the upper is nearer
    strain[4] = 1.005 * wanted[4];
    strain[5] = 0.99 * wanted[5];  // two that are equal: the first
    strain[6] = strain[5];
    strain[8] = 1.03 * wanted[8];  // too far
    const Replicates found = find_replicates({first, second}).front();
    const auto at = [&](Eigen::Index row) { return found.values(row, 1); };
    for (const Eigen::Index row : {0, 1, 4, 5, 7, 9}) {
        EXPECT_EQ(at(row), 100.0 + static_cast<double>(row));
    }
    EXPECT_TRUE(std::isnan(at(8)));
}

/// Two samples whose moduli follow their normal forces, which fall in another course each, with errors of 2 %.
std::vector<Measurement> pressed_samples(std::uint64_t seed, double force) {
    constexpr std::size_t rows = 20;
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<Measurement> tables;
    for (const double time : {100.0, 1000.0}) {
        Measurement table{.kind = MeasurementKind::time_sweep,
                          .label = "run",
                          .sample = std::to_string(tables.size()),
                          .columns = {},
                          .left_out = {}};
        table.columns = {{"time", "s", {}}, {"storage_modulus", "Pa", {}}, {"normal_force", "N", {}}};
        for (std::size_t row = 0; row < rows; ++row) {
            const double at = 60.0 * static_cast<double>(row + 1);
            const double load = force * std::exp(-at / time);
            const double modulus = 500 * (1 + 0.2 * static_cast<double>(tables.size())) * (1 + 0.1 * load);
            column(table, "time").values.push_back(at);
            column(table, "normal_force").values.push_back(load);
            column(table, "storage_modulus").values.push_back(modulus * (1 + 0.02 * normal(engine)));
        }
        tables.push_back(table);
    }
    return tables;
}

TEST(Replicates, OfSamplesUnderOtherLoadsDifferByTheirErrorsAlone) {
    double with = 0;
    double without = 0;
    double hidden = 0;
    constexpr int seeds = 40;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        std::vector<Measurement> tables = pressed_samples(seed, 3);
        const NoiseModel known = fit_noise(find_replicates(tables).front());
        EXPECT_EQ(known.degrees, 18);  // 40 values, 20 levels, 1 sample, 1 force
        with += std::pow(known.relative.value, 2) / seeds;
        for (Measurement& table : tables) {
            drop_column(table, "normal_force");
        }
        hidden += std::pow(fit_noise(find_replicates(tables).front()).relative.value, 2) / seeds;
        // Forces that differ by less than a transducer tells are left alone.
        const NoiseModel weak = fit_noise(find_replicates(pressed_samples(seed, 0.1)).front());
        EXPECT_EQ(weak.degrees, 19);
        without += std::pow(weak.relative.value, 2) / seeds;
    }
    // 40 times 18 degrees of freedom: their variance is known to 5 %.
    EXPECT_NEAR(with / 4e-4, 1, 0.15);
    EXPECT_NEAR(without / 4e-4, 1, 0.15);
    EXPECT_GT(hidden / 4e-4, 2);
}

}  // namespace
}  // namespace coagula::diagnose
