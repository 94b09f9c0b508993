#include <coagula/diagnose/noise.hpp>

#include "example_sweeps.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace coagula::diagnose
