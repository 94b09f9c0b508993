// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds that resist moments, contacts by Hertz and JKR, and prestress in the linear solver, against closed forms.
#include <coagula/mechanics/linear.hpp>

#include "networks.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/complaint.hpp"

namespace coagula::mechanics {
namespace {

using coagula::testing::alike;
using coagula::testing::bonds_between;
using coagula::testing::complaint;
using coagula::testing::random_spheres;

/// A straight row of touching spheres along x, its ends held.
struct Row {
    int links = 5;
    double radius = 0.25e-6;
    Packing packing;
    ContactNetwork bonds;
    LinearOptions options;

    explicit Row(const ContactModel& model) {
        packing.cell = Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(4e-6));
        packing.radii = Eigen::VectorXd::Constant(links + 1, radius);
        packing.positions = Eigen::Matrix3Xd::Constant(3, links + 1, 1e-6);
        packing.positions.row(0) = Eigen::RowVectorXd::LinSpaced(links + 1, 0, 2 * radius * links);
        std::vector<std::pair<int, int>> pairs;
        for (int link = 0; link < links; ++link) {
            pairs.emplace_back(link, link + 1);
        }
        bonds = bonds_between(packing, pairs);
        options.held.assign(static_cast<std::size_t>(links) + 1, false);
        options.held.front() = options.held.back() = true;
        options.volume = 1e-18;
        options.bond_tangents = bond_tangents(packing, bonds, model);
    }
    double distance() const { return 2 * radius; }
    /// The elastic constant when every link passes this force under unit strain; displacement of a link per unit strain `moved`.
    double constant(double force, double moved) const { return (links - 1) * force * moved / options.volume; }
    LinearResponse response() const { return solve_linear(packing, bonds, options); }
};

/// Force Q on the end of a clamped row of n links: displacement Q [n / k_s + d^2 n (n^2 - 1) / (12 k_b)], from the equilibrium of
/// each particle. The continuum has L^3 / (12 EI).
TEST(BondTangents, RowClampedAtBothEndsBendsInClosedForm) {
    for (const double twisting : {0.0, 3e-13}) {
        for (const double bending : {1e-16, 1e-13, 1e-10}) {
            const Row row({.bending_stiffness = bending, .twisting_stiffness = twisting});
            const double d = row.distance();
            const int n = row.links;
            const double compliance = n / 5.0 + d * d * n * (n * n - 1) / (12 * bending);
            const double expected = row.constant(0.5 * n * d / compliance, 0.5 * d);
            const LinearResponse found = row.response();
            EXPECT_NEAR(found.elastic_tensor(4, 4), expected, 1e-7 * expected) << bending;
            EXPECT_NEAR(found.elastic_tensor(5, 5), expected, 1e-7 * expected) << bending;
            EXPECT_NEAR(found.elastic_tensor(0, 0), row.constant(50 * d, d), 1e-9 * row.constant(50 * d, d));
            EXPECT_EQ(found.floppy_modes, twisting > 0 ? 0 : row.links - 1) << bending;  // the spins about the row
        }
    }
}

TEST(BondTangents, WithoutMomentsTheRowIsAMechanism) {
    const Row row({});
    EXPECT_LT(row.response().elastic_tensor(4, 4), 1e-7 * row.response().elastic_tensor(0, 0));
}

/// A string: transverse force P times slope.
TEST(BondTangents, TensionHoldsTheRowAsAString) {
    const double pull = 1e-7;
    const Row row({.shear_stiffness = 0, .prestress = -pull});
    const double d = row.distance();
    const double expected = row.constant(pull / d * 0.5 * d, 0.5 * d);
    EXPECT_NEAR(row.response().elastic_tensor(4, 4), expected, 1e-7 * expected);
    EXPECT_NEAR(row.response().elastic_tensor(5, 5), expected, 1e-7 * expected);
}

TEST(BondTangents, CompressionBucklesTheRow) {
    const Row row({.shear_stiffness = 0, .prestress = 1e-7});
    const std::string said = complaint([&] { row.response(); });
    EXPECT_NE(said.find("not stable under its prestress"), std::string::npos) << said;
}

TEST(BondTangents, HertzAndJohnsonKendallRobertsGiveTheirStiffness) {
    const double modulus = 70e9 / (2 * (1 - 0.0625));
    const double radius = 0.125e-6;  // of two equal spheres in contact
    const double d = 0.5e-6;
    const double force = 2e-7;
    const Row pressed({.bending_stiffness = 1e-10, .young_modulus = 70e9, .poisson_ratio = 0.25, .prestress = force});
    const double hertz = 2 * modulus * std::cbrt(0.75 * force * radius / modulus);  // 2 E* a
    const double expected = pressed.constant(hertz * d, d);
    EXPECT_NEAR(pressed.response().elastic_tensor(0, 0), expected, 1e-8 * expected);

    const Row adhesive({.young_modulus = 70e9, .poisson_ratio = 0.25, .work_of_adhesion = 0.5});
    const double jkr = 1.2 * modulus * std::cbrt(4.5 * std::numbers::pi * 0.5 * radius * radius / modulus);
    EXPECT_NEAR(adhesive.response().contact_normal_stiffness, jkr, 1e-9 * jkr);
    EXPECT_NEAR(adhesive.response().elastic_tensor(0, 0), adhesive.constant(jkr * d, d), 1e-8 * adhesive.constant(jkr * d, d));

    const Row loose({.young_modulus = 70e9, .poisson_ratio = 0.25});
    const std::string said = complaint([&] { loose.response(); });
    EXPECT_NE(said.find("needs prestress or adhesion"), std::string::npos) << said;
}

/// Rattlers and floppy modes included.
struct TangentNetwork {
    Packing packing = random_spheres(700, 17.0, 0.25e-6, 4);
    ContactNetwork bonds = find_contacts(packing, 0.05);

    LinearResponse with(const ContactModel& model, LinearOptions options = {}) const {
        options.bond_tangents = bond_tangents(packing, bonds, model);
        return solve_linear(packing, bonds, options);
    }
};

TEST(BondTangents, OfTheSpringsAloneAreTheSprings) {
    const TangentNetwork sample;
    const LinearResponse plain = solve_linear(sample.packing, sample.bonds);
    const LinearResponse same = sample.with({});
    EXPECT_LT((same.elastic_tensor - plain.elastic_tensor).norm(), 1e-12 * plain.elastic_tensor.norm());
    EXPECT_EQ(same.rattlers, plain.rattlers);
    EXPECT_EQ(same.floppy_modes, plain.floppy_modes);
}

TEST(BondTangents, MomentsStiffenANetworkAndLeaveNothingFree) {
    const TangentNetwork sample;
    const double unit = 50 * 0.25e-6 * 0.25e-6;
    const double plain = sample.with({}).mean_shear_modulus();
    const LinearResponse bending = sample.with({.bending_stiffness = 1e-3 * unit});
    const LinearResponse both = sample.with({.bending_stiffness = 1e-3 * unit, .twisting_stiffness = 1e-3 * unit});
    const LinearResponse twisting = sample.with({.twisting_stiffness = 1e-3 * unit});
    EXPECT_GT(bending.mean_shear_modulus(), 1.01 * plain);
    EXPECT_GT(both.mean_shear_modulus(), bending.mean_shear_modulus());
    EXPECT_GT(twisting.mean_shear_modulus(), plain);
    EXPECT_LT(twisting.mean_shear_modulus(), both.mean_shear_modulus());
    EXPECT_LT(bending.rattlers, sample.with({}).rattlers);
    // Little stiffness, little effect.
    EXPECT_NEAR(sample.with({.bending_stiffness = 1e-11 * unit}).mean_shear_modulus(), plain, 1e-4 * plain);
}

TEST(BondTangents, DirectAndIterativeSolverAndAnyShiftAgree) {
    const TangentNetwork sample;
    const ContactModel model{.bending_stiffness = 3e-15, .prestress = -1e-9};
    const LinearResponse reference = sample.with(model);
    LinearOptions options;
    options.shift = 1e-8;
    EXPECT_LT((sample.with(model, options).elastic_tensor - reference.elastic_tensor).norm(),
              1e-8 * reference.elastic_tensor.norm());
    options.solver = LinearSolver::iterative;
    options.modulus_tolerance = 1e-7;
    EXPECT_LT((sample.with(model, options).elastic_tensor - reference.elastic_tensor).norm(),
              1e-5 * reference.elastic_tensor.norm());
}

TEST(BondTangents, SameBitsForOneAndTwoThreads) {
    const TangentNetwork sample;
    const ContactModel model{.bending_stiffness = 3e-15, .twisting_stiffness = 1e-15};
    omp_set_num_threads(1);
    const auto one = sample.with(model);
    omp_set_num_threads(2);
    const auto two = sample.with(model);
    EXPECT_TRUE(one.elastic_tensor == two.elastic_tensor);
    EXPECT_TRUE(one.rotation[3] == two.rotation[3]);
}

TEST(BondTangents, RefusesWhatDoesNotFit) {
    const TangentNetwork sample;
    LinearOptions options;
    options.bond_tangents = alike(sample.bonds, {.normal = 50});
    options.bond_tangents.pop_back();
    EXPECT_THROW(solve_linear(sample.packing, sample.bonds, options), std::invalid_argument);
    options.bond_tangents = alike(sample.bonds, {.normal = 50, .bending = -1});
    EXPECT_THROW(solve_linear(sample.packing, sample.bonds, options), std::invalid_argument);
    EXPECT_THROW(bond_tangents(sample.packing, sample.bonds, {.normal_stiffness = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
