// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasistatic/updated_factor.hpp"

#include "quasistatic_examples.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

using quasistatic_examples::Columns;
using quasistatic_examples::gel;
using quasistatic_examples::radius;
using quasistatic_examples::springs;

/// Joints with moments, so that the factor's shift hardly matters.
ContactModel joints_with_moments() {
    ContactModel model;
    model.normal_stiffness = 100;
    model.shear_stiffness = 10;
    model.bending_stiffness = 3e-14;
    model.twisting_stiffness = 3e-14;
    model.friction = 0.05;
    return model;
}

/// Residual of K x = b with the tangent of the network as it is now.
double error_of(const UpdatedFactor& factor, const ShearedNetwork& network, const Trial& trial, const Motion& load) {
    return (StiffnessOfContacts(network, trial) * factor.solve(load) - load).norm() / load.norm();
}

/// A load that no rigid translation sees.
Motion some_load(const ShearedNetwork& network, const Trial& trial) {
    return StiffnessOfContacts(network, trial) * Motion::LinSpaced(6 * network.particles(), -1, 2).array().sin().matrix();
}

/// No particle is left with fewer than two bonds: without any it would move freely, and the factor's shift would be all that holds
/// it.
void break_every_twentieth(ShearedNetwork& network, const ContactNetwork& bonds) {
    std::vector<int> count(static_cast<std::size_t>(network.particles()), 0);
    for (const auto particle : bonds.ends.reshaped()) {
        ++count[static_cast<std::size_t>(particle)];
    }
    for (Index bond = 0; bond < bonds.size(); bond += 20) {
        int& first = count[static_cast<std::size_t>(bonds.ends(0, bond))];
        int& second = count[static_cast<std::size_t>(bonds.ends(1, bond))];
        if (first > 2 && second > 2) {
            --first;
            --second;
            network.break_bond(bond);
        }
    }
}

/// The difference quotient must not reach to where the contact is open.
TEST(ShearedNetwork, ContactsThatHardlyTouchAreAsStiffAsOthers) {
    const double touching = 2 * radius;
    for (const double overlap : {1e-4, 1e-8, 1e-9, 1e-11}) {
        Columns pair({20 * radius, 20 * radius, 20 * radius}, {radius, radius});
        pair.packing.positions.col(1) = pair.packing.positions.col(0) + Eigen::Vector3d(0, 0, touching - overlap * radius);
        pair.join(0, 1, {0, 0, touching - overlap * radius});
        ShearedNetwork network(pair.packing, pair.bonds, springs(), {.rest_length = RestLength::touching});
        network.break_bond(0);
        Trial trial;
        network.evaluate(0, Motion::Zero(12), trial);
        EXPECT_NEAR(network.linearise(trial).front()(2, 2), 1, 1e-3) << "overlap " << overlap;
    }
}

TEST(UpdatedFactor, FollowsBrokenBonds) {
    const auto sample = gel(200);
    ShearedNetwork network(sample.packing, sample.contacts, joints_with_moments(), {});
    Trial trial;
    const Motion still = Motion::Zero(6 * network.particles());
    network.evaluate(0, still, trial);
    UpdatedFactor factor(network, trial);
    EXPECT_LT(error_of(factor, network, trial, some_load(network, trial)), 1e-3);
    EXPECT_FALSE(factor.update(network, trial)) << "nothing has changed";

    for (const Index bond : {3, 50, 101}) {
        network.break_bond(bond);
    }
    network.evaluate(0, still, trial);
    const Motion load = some_load(network, trial);
    EXPECT_GT(error_of(factor, network, trial, load), 1e-2) << "the test must see broken bonds";
    EXPECT_TRUE(factor.update(network, trial));
    EXPECT_EQ(factor.rank(), 18);
    EXPECT_LT(error_of(factor, network, trial, load), 1e-3);
    EXPECT_FALSE(factor.update(network, trial));
    EXPECT_EQ(factor.factorisations(), 1);
}

/// A slipping contact has an unsymmetric tangent, which no Cholesky factor holds.
TEST(UpdatedFactor, FollowsContactsThatSlip) {
    const auto sample = gel(200);
    ShearedNetwork network(sample.packing, sample.contacts, joints_with_moments(), {});
    break_every_twentieth(network, sample.contacts);
    Trial trial;
    Motion motion(6 * network.particles());
    for (Index particle = 0; particle < network.particles(); ++particle) {
        motion.segment<6>(6 * particle) = Eigen::Matrix<double, 6, 1>::Zero();
        motion.segment<3>(6 * particle) = -1e-3 * sample.packing.positions.col(particle) / 0.25e-6;  // pressed together
    }
    network.evaluate(0, motion, trial);
    network.commit(trial);
    network.evaluate(1e-3, Motion::Zero(motion.size()), trial);
    double asymmetry = 0;
    for (const Slope& slope : network.linearise(trial)) {
        asymmetry = std::max(asymmetry, (slope - slope.transpose()).norm());
    }
    ASSERT_GT(asymmetry, 0.05) << "a contact must slip";
    const UpdatedFactor factor(network, trial);
    EXPECT_GT(factor.rank(), 0);
    EXPECT_LT(error_of(factor, network, trial, some_load(network, trial)), 0.05);
}

}  // namespace
}  // namespace coagula::mechanics
