// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static uniaxial compression: lattices in closed form, the linear solver, energy, other edges of the same box.
#include <coagula/mechanics/quasistatic.hpp>

#include "diluted_crystal.hpp"
#include "quasistatic_examples.hpp"
#include "support/boxes.hpp"

#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::mechanics {
namespace {

using coagula::testing::skewed;
using quasistatic_examples::Columns;
using quasistatic_examples::gel;
using quasistatic_examples::radius;
using quasistatic_examples::springs;

constexpr double contact_stiffness = 50;  // of two particles of 100 N/m in series

/// Bonds that resist bending, so that no part of the network is floppy.
ContactModel stiff_joints() {
    ContactModel model = springs();
    model.bending_stiffness = 1e-2 * contact_stiffness * radius * radius;
    model.twisting_stiffness = model.bending_stiffness;
    return model;
}

RampResponse strain_along(int axis, const Packing& packing, const ContactNetwork& bonds, const ContactModel& model, double strain,
                          Index steps = 4) {
    return shear_to(packing, bonds, model, {.strain = strain, .steps = steps, .solver = {.orientation = {axis, axis}}});
}

/// The force of a bond is its stiffness times its change of length, and the area that it bears stays: stress = k e / 2 r at any
/// strain, nothing sidewards, and the work is the energy of the spring.
TEST(UniaxialStrain, SimpleCubicLatticeInClosedForm) {
    const double length = 2 * radius;
    Columns lattice({length, length, length}, {radius});
    lattice.join(0, {length, 0, 0});
    lattice.join(0, {0, length, 0});
    lattice.join(0, {0, 0, length});
    for (int axis = 0; axis < 3; ++axis) {
        for (const double strain : {-0.2, 0.1}) {
            const RampResponse ramp = strain_along(axis, lattice.packing, lattice.bonds, springs(), strain);
            ASSERT_GE(ramp.points.size(), 5U);
            for (const StrainPoint& point : ramp.points) {
                Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
                expected(axis, axis) = contact_stiffness * point.strain / length;
                EXPECT_LT((point.stress - expected).norm(), 1e-9 * contact_stiffness / length) << axis << ", " << point.strain;
                const double energy = 0.5 * contact_stiffness * std::pow(length * point.strain, 2);
                EXPECT_NEAR(point.work, energy, 1e-9 * energy);
                EXPECT_NEAR(point.stored, energy, 1e-9 * energy);
            }
        }
    }
}

TEST(UniaxialStrain, SmallStrainIsTheElasticTensor) {
    const auto sample = gel(200);
    const LinearResponse linear = solve_linear(sample.packing, sample.contacts);
    for (const ShearOrientation& orientation : uniaxial_orientations()) {
        const int axis = orientation.normal;
        const RampResponse ramp = strain_along(axis, sample.packing, sample.contacts, springs(), -1e-6, 1);
        EXPECT_NEAR(ramp.secant_modulus(1, orientation) / linear.elastic_tensor(axis, axis), 1, 1e-4) << axis;
        for (int beside = 0; beside < 3; ++beside) {
            const StrainPoint& last = ramp.points.back();
            EXPECT_NEAR(last.stress(beside, beside) / last.strain / linear.elastic_tensor(axis, beside), 1, 1e-3) << axis << beside;
        }
    }
}

/// Stress comes from the branches, energy from the law: over a strain that moves them far, one is the derivative of the other.
TEST(UniaxialStrain, WorkIsTheEnergyStored) {
    const coagula::testing::DilutedCrystal crystal;
    const RampResponse ramp = strain_along(2, crystal.packing, crystal.bonds, springs(), -0.004, 2);
    const StrainPoint& last = ramp.points.back();
    ASSERT_EQ(last.strain, -0.004);
    EXPECT_TRUE(ramp.broken.empty());
    EXPECT_GT(last.stored, 0);
    EXPECT_LT(std::abs(last.work - last.stored - last.dissipated - last.released), 1e-5 * last.work);
    EXPECT_LT(last.stress(2, 2), 0) << "pressed";
}

/// Particles that are a tenth of their diameter apart touch their images when the cell is a tenth lower, and push as springs do
/// then; the neighbours have to be looked for again on the way.
TEST(UniaxialStrain, ParticlesThatWereApartTouchAndPush) {
    const double gap = 0.2 * radius;
    const double wide = 2 * radius;
    const double height = 2 * radius + gap;
    Columns column({wide, 20 * radius, height}, {radius});
    column.join(0, {wide, 0, 0});
    const RampResponse ramp = strain_along(2, column.packing, column.bonds, springs(), -0.3, 30);
    int pushed = 0;
    for (const StrainPoint& point : ramp.points) {
        const double overlap = std::max(0.0, 2 * radius - height * (1 + point.strain));
        const double expected = -contact_stiffness * overlap / (wide * 20 * radius);
        EXPECT_NEAR(point.stress(2, 2), expected, 1e-6 * contact_stiffness / wide) << point.strain;
        pushed += overlap > 0 ? 1 : 0;
    }
    EXPECT_GE(pushed, 20);
    EXPECT_EQ(ramp.points.back().contacts, 1);
}

TEST(UniaxialStrain, ChainBreaksAtItsStrengthWhenStretched) {
    const double length = 2 * radius;
    Columns chain({20 * radius, 20 * radius, length}, {radius});
    chain.join(0, {0, 0, length});
    ContactModel model = springs();
    model.normal_strength = 0.02 * contact_stiffness * length;
    const RampResponse ramp = strain_along(2, chain.packing, chain.bonds, model, 0.05);
    ASSERT_EQ(ramp.broken.size(), 1U);
    EXPECT_NEAR(ramp.broken[0].strain, 0.02, 1e-10);
    ASSERT_TRUE(ramp.failure);
    EXPECT_TRUE(ramp.failure->parted);
    EXPECT_NEAR(ramp.points.back().breakage / (0.5 * contact_stiffness * std::pow(0.02 * length, 2)), 1, 1e-8);
}

/// Bonds break and friction slips, and yet nothing of the work is lost; a network under compression is never given up.
TEST(UniaxialStrain, CompressionBreaksBondsAndBalancesTheEnergy) {
    const auto sample = gel(60);
    ContactModel model = stiff_joints();
    model.normal_strength = 1.2e-8;
    model.shear_strength = 0.6e-8;
    model.friction = 0.3;
    const RampResponse ramp = strain_along(1, sample.packing, sample.contacts, model, -0.004, 4);
    const StrainPoint& last = ramp.points.back();
    EXPECT_EQ(last.strain, -0.004);
    EXPECT_GT(ramp.broken.size(), 5U);
    EXPECT_LT(std::abs(last.imbalance(ramp.points.front())), 1e-5 * last.work);
    EXPECT_GT(last.breakage, 0);
    EXPECT_FALSE(ramp.failure && ramp.failure->parted);
}

TEST(UniaxialStrain, DoesNotDependOnTheEdgesOfTheBox) {
    const auto sample = gel(60);
    const Packing tilted = skewed(sample.packing);
    const RampResponse straight = strain_along(0, sample.packing, sample.contacts, stiff_joints(), -0.001, 1);
    const RampResponse other = strain_along(0, tilted, find_contacts(tilted, 0.01), stiff_joints(), -0.001, 1);
    EXPECT_LT((straight.points.back().stress - other.points.back().stress).norm(), 1e-5 * straight.points.back().stress.norm());
}

TEST(UniaxialStrain, RefusesACellWithoutHeight) {
    const double length = 2 * radius;
    Columns chain({20 * radius, 20 * radius, length}, {radius});
    chain.join(0, {0, 0, length});
    EXPECT_THROW(strain_along(2, chain.packing, chain.bonds, springs(), -1), std::invalid_argument);
    EXPECT_THROW(sweep_amplitudes(chain.packing, chain.bonds, springs(), {.amplitudes = {1.0}, .solver = {.orientation = {2, 2}}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
