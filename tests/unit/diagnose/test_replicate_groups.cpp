// SPDX-License-Identifier: GPL-3.0-or-later
// What replicates leave over, by groups.
#include <coagula/diagnose/replicate_groups.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// A frequency sweep with errors of 1 %, a level of its own, and a slope over the two decades of the frequency.
Measurement repeated(const std::string& sample, std::uint64_t seed, double slope = 0) {
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "sweep of " + sample + " " + std::to_string(seed);
    table.sample = sample;
    table.columns = {
        {"angular_frequency", "rad/s", logarithmic_steps(1, 100, 14)}, {"storage_modulus", "Pa", {}}, {"loss_modulus", "Pa", {}}};
    const double level = 1e4 * (1 + 0.1 * drawn_normal(seed, 100));
    for (std::size_t row = 0; row < 14; ++row) {
        const double size = level * (1 + slope * (static_cast<double>(row) / 13 - 0.5));
        table.columns[1].values.push_back(size * (1 + 0.01 * drawn_normal(seed, 2 * row)));
        table.columns[2].values.push_back(0.1 * size * (1 + 0.01 * drawn_normal(seed, 2 * row + 1)));
    }
    return table;
}

TEST(ReplicateGroups, AreNotFoundInReplicatesOfOneCourse) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        std::vector<Measurement> tables{repeated("A", 10 * seed), repeated("B", 10 * seed + 1), repeated("C", 10 * seed + 2),
                                        repeated("C", 10 * seed + 3)};
        EXPECT_TRUE(groups_of_replicates(tables).empty()) << seed;
    }
}

TEST(ReplicateGroups, AreNotFoundInTwoTables) {
    EXPECT_TRUE(groups_of_replicates({repeated("A", 1), repeated("B", 2, 0.3)}).empty());  // nobody knows which
}

TEST(ReplicateGroups, OneSampleOfThreeIsNamed) {
    const std::vector<Measurement> tables{repeated("A", 1), repeated("B", 2), repeated("C", 3, 0.3)};
    const std::vector<ReplicateGroups> found = groups_of_replicates(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].by, GroupedBy::single_sample);
    EXPECT_EQ(found[0].names, std::vector<std::string>{"C"});
    EXPECT_NEAR(found[0].between, 0.09, 0.03);  // a slope of 0.3 has an rms of 0.3 / sqrt(12)
    EXPECT_NEAR(found[0].within, 0.014, 0.006);
}

TEST(ReplicateGroups, InstrumentsAndDaysAreNamedWhereTheyAreStated) {
    std::vector<Measurement> tables{repeated("A", 1), repeated("B", 2), repeated("C", 3, 0.3), repeated("D", 4, 0.3)};
    EXPECT_TRUE(groups_of_replicates(tables).empty()) << "nothing says what the four have in common";
    for (std::size_t table = 0; table < 4; ++table) {
        tables[table].instrument = table < 2 ? "DHR" : "MCR";
    }
    ASSERT_EQ(groups_of_replicates(tables).size(), 1U);
    EXPECT_EQ(groups_of_replicates(tables)[0].by, GroupedBy::instrument);
    EXPECT_EQ(groups_of_replicates(tables)[0].names, (std::vector<std::string>{"DHR", "MCR"}));
    for (std::size_t table = 0; table < 4; ++table) {
        tables[table].instrument.clear();
        tables[table].start = 86400.0 * (table < 2 ? 1 : 2) + 3600;
    }
    ASSERT_EQ(groups_of_replicates(tables).size(), 1U);
    EXPECT_EQ(groups_of_replicates(tables)[0].by, GroupedBy::day);
}

TEST(ReplicateGroups, RunsOnOneSampleAgreeAmongThemselves) {
    const std::vector<Measurement> tables{repeated("A", 1), repeated("A", 2), repeated("B", 3, 0.3), repeated("B", 4, 0.3)};
    ASSERT_EQ(groups_of_replicates(tables).size(), 1U);
    EXPECT_EQ(groups_of_replicates(tables)[0].by, GroupedBy::sample);
}

}  // namespace
}  // namespace coagula::diagnose
