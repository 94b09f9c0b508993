// SPDX-License-Identifier: GPL-3.0-or-later
// A table that lies far off its replicates as a whole.
#include <coagula/diagnose/lone_tables.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// Returns the level of a sample over the mean of all.
double level_of(std::uint64_t seed) {
    return 1 + 0.1 * drawn_normal(seed, 100);
}

/// A frequency sweep with errors of 1 % and a level of its own, whose moduli are multiplied by a factor.
Measurement repeated(const std::string& sample, std::uint64_t seed, std::complex<double> factor = 1, double loss_factor = 1) {
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "sweep of " + sample;
    table.sample = sample;
    table.columns = {
        {"angular_frequency", "rad/s", logarithmic_steps(1, 100, 14)}, {"storage_modulus", "Pa", {}}, {"loss_modulus", "Pa", {}}};
    const double level = 1e4 * level_of(seed);
    for (std::size_t row = 0; row < 14; ++row) {
        const std::complex<double> modulus = factor * level * std::complex<double>(1, 0.1);
        const double error = 0.01 * std::abs(modulus);
        table.columns[1].values.push_back(modulus.real() + error * drawn_normal(seed, 2 * row));
        table.columns[2].values.push_back(loss_factor * (modulus.imag() + error * drawn_normal(seed, 2 * row + 1)));
    }
    return table;
}

TEST(LoneTables, AreNotFoundAmongReplicatesWithLevelsOfTheirOwn) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        EXPECT_TRUE(lone_tables({repeated("A", 10 * seed), repeated("B", 10 * seed + 1), repeated("C", 10 * seed + 2)}).empty())
            << seed;
        EXPECT_TRUE(lone_tables({repeated("A", 10 * seed + 3), repeated("B", 10 * seed + 4)}).empty()) << seed;
    }
}

TEST(LoneTables, AUnitThatIsWrongIsToldByItsFactor) {
    const std::vector<Measurement> tables{repeated("A", 1), repeated("B", 2, 1e-3), repeated("C", 3)};
    const std::vector<LoneTable> found = lone_tables(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].sample, "B");
    EXPECT_EQ(found[0].observable, "complex_modulus");
    EXPECT_NEAR(std::log10(found[0].difference), -3, 0.1);
    EXPECT_EQ(found[0].label, "sweep of B");
    EXPECT_FALSE(found[0].one_of_two);
}

TEST(LoneTables, APhaseIsToldByItsAngle) {
    const std::vector<Measurement> tables{repeated("A", 1), repeated("B", 2), repeated("C", 3, std::polar(1.0, 0.2))};
    const std::vector<LoneTable> found = lone_tables(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].sample, "C");
    EXPECT_EQ(found[0].observable, "phase");
    EXPECT_NEAR(found[0].difference, 0.2, 0.02);
    EXPECT_FALSE(found[0].one_of_two);
}

TEST(LoneTables, ALossModulusThatIsMissingInOneSampleIsAPhase) {
    const std::vector<LoneTable> found = lone_tables({repeated("A", 1), repeated("B", 2, 1, 1e-3), repeated("C", 3)});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].sample, "B");
    EXPECT_EQ(found[0].observable, "phase");
    EXPECT_NEAR(found[0].difference, -0.1, 0.02);
}

/// Two agree to 5 % here, the third is softer by 40 %: less than the factor of an obvious mistake, and no scatter either.
TEST(LoneTables, OneSampleOfThreeIsApart) {
    const std::vector<Measurement> tables{repeated("A", 1, 1 / level_of(1)), repeated("B", 2, 1.05 / level_of(2)),
                                          repeated("C", 3, 0.55 / level_of(3))};
    const std::vector<LoneTable> found = lone_tables(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].sample, "C");
    EXPECT_NEAR(found[0].difference, 0.55 / 1.025, 0.01);
    EXPECT_TRUE(lone_tables({tables[0], tables[2]}).empty()) << "nobody knows what two samples differ by";
}

/// Runs on one sample agree, which says nothing about how samples differ.
TEST(LoneTables, RunsOnOneSampleAreNoSamples) {
    EXPECT_TRUE(
        lone_tables({repeated("A", 1, 1 / level_of(1)), repeated("A", 2, 1 / level_of(2)), repeated("B", 3, 0.65 / level_of(3))})
            .empty());
}

TEST(LoneTables, NobodyKnowsWhichOfTwoIsWrong) {
    const std::vector<Measurement> tables{repeated("A", 1), repeated("B", 2, 10)};
    const std::vector<LoneTable> found = lone_tables(tables);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].one_of_two);
    EXPECT_TRUE(found[0].other.starts_with("sweep of ")) << found[0].other;
}

}  // namespace
}  // namespace coagula::diagnose
