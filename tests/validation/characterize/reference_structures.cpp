// SPDX-License-Identifier: GPL-3.0-or-later
// Packings of 8000 spheres with independently computed values (two million random points, another program), and Finney's measured
// random close packing.
#include "unit/characterize/test_packings.hpp"

#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/characterize/inner_particles.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace coagula::characterize {
namespace {

class ReferenceStructure : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        packing = test::reference_structure(GetParam());
        std::ifstream file = testing::open_dataset(testing::dataset("reference_structures/reference.json"));
        expected = nlohmann::json::parse(file).at(GetParam());
    }

    Packing packing;
    nlohmann::json expected;
};

/// The part of the curve that the reference's random points reached: some 1.2 million in the void.
PoreSizes reached_by_sampling(const PoreSizes& pores) {
    const Index reached = (pores.exclusion_probability.array() > 1 / 1.2e6).count();
    PoreSizes part = pores;
    part.radius.conservativeResize(reached);
    part.exclusion_probability.conservativeResize(reached);
    return part;
}

TEST_P(ReferenceStructure, PoresAndHeterogeneity) {
    constexpr double r0 = 2.5e-7;
    const PoreSizes pores = measure_pores(packing);
    EXPECT_LT(pores.cell_volume_defect, 1e-11);
    EXPECT_NEAR(pores.mean / r0, expected.at("mean_pore_r0").get<double>(), 0.001);
    const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(pores, r0);
    EXPECT_NEAR(fit.a, expected.at("doh_a").get<double>(), 0.002);
    EXPECT_NEAR(fit.b, expected.at("doh_b").get<double>(), 0.002);
    const DegreeOfHeterogeneity sampled_part = fit_degree_of_heterogeneity(reached_by_sampling(pores), r0);
    EXPECT_NEAR(sampled_part.a, expected.at("doh_a").get<double>(), 0.002);
    EXPECT_NEAR(sampled_part.rms_residual, expected.at("rms").get<double>(), 0.0005);
}

TEST_P(ReferenceStructure, Coordination) {
    const Coordination coordination = measure_coordination(packing, {.contact_tolerance = 0.01});
    constexpr double half_a_digit = 0.0005 + 1e-12;  // the reference is rounded to three decimals
    EXPECT_NEAR(coordination.mean, expected.at("coordination_1pct").get<double>(), half_a_digit);
    EXPECT_NEAR(coordination.below_three_fraction, expected.at("fraction_below_3_contacts").get<double>(), half_a_digit);
}

INSTANTIATE_TEST_SUITE_P(Structures, ReferenceStructure,
                         ::testing::Values("vem_1-8", "vem_1-2", "vem_2-1", "brownian_0mV", "brownian_15mV"), [](const auto& test) {
                             std::string name = test.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

/// Finney's ball bearings of radius 1, a sample with a free surface.
Packing finney() {
    Packing packing;
    packing.positions = test::read_columns(testing::dataset("finney_pack/finney.csv"), 1);
    const Eigen::Vector3d lower = packing.positions.rowwise().minCoeff();
    packing.cell = Cell::open(lower, packing.positions.rowwise().maxCoeff() - lower);
    packing.radii = Eigen::VectorXd::Ones(packing.size());
    return packing;
}

TEST(Finney, CoordinationOfTheInnerPart) {
    const Packing packing = finney();
    for (const auto& [tolerance, published] : {std::pair{0.01, 6.3}, {0.02, 6.9}, {0.05, 7.9}, {0.10, 9.0}}) {
        const Coordination coordination = measure_coordination(packing, {.contact_tolerance = tolerance});
        EXPECT_GT(coordination.inner_particles, 2000);
        EXPECT_NEAR(coordination.mean, published, 0.051) << "within " << 1 + tolerance << " diameters";
        EXPECT_LT(coordination.mean_all, coordination.mean - 0.3);
    }
}

TEST(Finney, PoresOfTheInnerPart) {
    const Packing packing = finney();
    const PoreSizes pores = measure_pores(packing);
    EXPECT_GT(pores.inner_particles, 2000);
    EXPECT_NEAR(1 - pores.void_fraction, 0.64, 0.003);  // the density that Finney is known for: 0.6366
    EXPECT_GT(pores.max, 0.4);                          // more than the octahedral hole of close-packed spheres
    EXPECT_LT(pores.max, 1.0);
}

}  // namespace
}  // namespace coagula::characterize
