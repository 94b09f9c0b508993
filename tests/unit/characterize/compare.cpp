// SPDX-License-Identifier: GPL-3.0-or-later
// Two structures compared by three measures of heterogeneity.
#include <coagula/characterize/compare.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "test_packings.hpp"

namespace coagula::characterize {
namespace {

ComparedMeasure measured(double first, double second, double error) {
    return {"measure", "", {first, second}, {error, error}};
}

TEST(Comparison, NeedsTwoStandardErrorsOfTheDifference) {
    EXPECT_FALSE(measured(1, 1.28, 0.1).more_heterogeneous().has_value());  // two errors: 0.283
    EXPECT_EQ(measured(1, 1.29, 0.1).more_heterogeneous(), 1U);
    EXPECT_EQ(measured(1, 0.7, 0.1).more_heterogeneous(), 0U);
    EXPECT_FALSE(measured(1, 9, unset).more_heterogeneous().has_value());
}

TEST(Comparison, SaysWhetherTheMeasuresAgree) {
    HeterogeneityComparison comparison;
    comparison.measures = {measured(1, 2, 0.1), measured(1, 2, 0.1), measured(1, 2, 0.1)};
    EXPECT_EQ(comparison.agreement(), Agreement::all);
    EXPECT_EQ(comparison.more_heterogeneous(), 1U);
    comparison.measures[0] = measured(1, 1, 0.1);
    EXPECT_EQ(comparison.agreement(), Agreement::some);
    EXPECT_EQ(comparison.more_heterogeneous(), 1U);
    comparison.measures[0] = measured(2, 1, 0.1);
    EXPECT_EQ(comparison.agreement(), Agreement::disagree);
    EXPECT_FALSE(comparison.more_heterogeneous().has_value());
    comparison.measures = {measured(1, 1, 0.1)};
    EXPECT_EQ(comparison.agreement(), Agreement::none);
}

MeasureInput input(const Packing& packing) {
    return MeasureInput(packing, {{"radii", 20}, {"pore-tolerance", 1e-3}});
}

/// A lattice whose particles are displaced by up to a tenth of its edge: far more even than points at random.
Packing shaken_lattice(int along, double edge) {
    Packing packing = test::lattice({{0, 0, 0}}, edge, {along, along, along}, 0.5);
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Vector3d step = random_uniform(1, RandomPurpose::test, 3, static_cast<std::uint64_t>(i));
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i) + 0.2 * edge * step);
    }
    return packing;
}

TEST(Comparison, RandomPointsAreMoreHeterogeneousThanALattice) {
    const Packing random = test::random_spheres(512, Eigen::Vector3d::Constant(12), 0.5, 0.5, 2);
    const HeterogeneityComparison found = compare_heterogeneity(input(shaken_lattice(8, 1.5)), input(random));
    ASSERT_EQ(found.measures.size(), 3U);
    EXPECT_EQ(found.agreement(), Agreement::all);
    EXPECT_EQ(found.more_heterogeneous(), 1U);
    EXPECT_GT(found.main_part.difference(), 0);
    EXPECT_GT(found.fluctuations.difference, 0);
    EXPECT_GE(found.fluctuations.edge, 2);
    EXPECT_LE(found.fluctuations.edge, 12);  // half the box, in units of the radius
    EXPECT_TRUE(found.unfair.empty());
}

/// Lengths count in units of the radius alone.
TEST(Comparison, DoesNotSeeTheUnitOfLength) {
    const Packing one = test::random_spheres(512, Eigen::Vector3d::Constant(12), 0.5, 0.5, 2);
    Packing other = one;
    other.cell = Cell::periodic(3e-6 * one.cell.lengths());
    other.positions *= 3e-6;
    other.radii *= 3e-6;
    const HeterogeneityComparison found = compare_heterogeneity(input(one), input(other));
    EXPECT_EQ(found.agreement(), Agreement::none);
    for (const ComparedMeasure& measure : found.measures) {
        EXPECT_NEAR(measure.difference(), 0, 1e-6 * measure.value[0]) << measure.name;
    }
    EXPECT_NEAR(found.fluctuations.difference, 0, 1e-6);
    EXPECT_TRUE(found.unfair.empty());
}

TEST(Comparison, SaysWhyItIsNotFair) {
    const auto made = [](Index particles, double edge, double smallest, double largest) {
        return test::random_spheres(particles, Eigen::Vector3d::Constant(edge), smallest, largest, 2);
    };
    const Packing base = made(216, 9, 0.5, 0.5);
    const auto only_reason = [&](const Packing& other) {
        const std::vector<std::string> reasons = compare_heterogeneity(input(base), input(other)).unfair;
        return reasons.size() == 1 ? reasons[0] : std::to_string(reasons.size()) + " reasons";
    };
    EXPECT_NE(only_reason(made(216, 9, 0.51, 0.51)).find("volume fractions"), std::string::npos);
    Packing unequal = made(216, 9, 0.46, 0.54);
    unequal.radii *= std::cbrt(volume_fraction(base) / volume_fraction(unequal));
    EXPECT_NE(only_reason(unequal).find("radii"), std::string::npos);
    EXPECT_NE(only_reason(made(64, 6, 0.5, 0.5)).find("64"), std::string::npos);
}

TEST(Comparison, SmallBoxesAreComparedOverTheWindowsThatBothHave) {
    const Packing one = test::random_spheres(216, Eigen::Vector3d::Constant(9), 0.5, 0.5, 2);
    const Packing other = test::random_spheres(216, Eigen::Vector3d::Constant(9), 0.5, 0.5, 3);
    Packing coarse = test::random_spheres(64, Eigen::Vector3d::Constant(6), 0.5, 0.5, 3);
    const HeterogeneityComparison found = compare_heterogeneity(input(one), input(coarse));
    ASSERT_EQ(found.measures.size(), 3U);
    EXPECT_NE(found.measures[2].meaning.find("2 to 6"), std::string::npos) << found.measures[2].meaning;
    EXPECT_TRUE(compare_heterogeneity(input(one), input(other)).left_out.empty());
}

}  // namespace
}  // namespace coagula::characterize
