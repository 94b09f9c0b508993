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
    for (double& storage : column(second, "storage_modulus").values) {
        storage *= 0.7;
    }
    const std::vector<Replicates> found = find_replicates({sweep_of("A"), second});
    ASSERT_EQ(found.size(), 2u);  // G' and G''
    EXPECT_EQ(found[0].observable, "storage_modulus");
    EXPECT_EQ(found[0].samples, (std::vector<std::string>{"A", "B"}));
    EXPECT_TRUE(found[0].floor_of_stress);
    for (Eigen::Index row = 0; row < found[0].values.rows(); ++row) {
        EXPECT_DOUBLE_EQ(found[0].values(row, 1), 0.7 * found[0].values(row, 0));
        EXPECT_DOUBLE_EQ(found[0].floor_weights[row], 1 / found[0].axis[row]);
    }
}

TEST(Replicates, DifferInFrequencyOrKindThenTheyAreNone) {
    Measurement faster = sweep_of("B");
    for (double& frequency : column(faster, "angular_frequency").values) {
        frequency *= 2;
    }
    EXPECT_EQ(find_replicates({sweep_of("A"), faster}).size(), 4u);
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

}  // namespace
}  // namespace coagula::diagnose
