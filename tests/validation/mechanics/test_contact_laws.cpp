// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesive and prestressed contacts: one modulus by the tangent of the linear solver, by equilibria and by explicit steps.
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/quasistatic.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include "support/lattices.hpp"

namespace coagula::mechanics {
namespace {

constexpr double strain = 1e-6;
constexpr ShearOrientation zx{2, 0};

struct Network {
    Packing packing;
    ContactNetwork bonds;
};

/// Bonded also over gaps, so that no soft mode makes short explicit runs inaccurate.
const Network& disordered() {
    static const Network made = [] {
        generators::VoidExpansionOptions options;
        options.particles = 300;
        options.voids = 75;
        options.volume_fraction = 0.4;
        options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
        const Packing packing = generators::expand_voids(options).packing;
        return Network{packing, find_contacts(packing, 0.1)};
    }();
    return made;
}

double linear_modulus(const Network& network, const ContactModel& model) {
    LinearOptions options;
    options.bond_tangents = bond_tangents(network.packing, network.bonds, model);
    return solve_linear(network.packing, network.bonds, options).shear_modulus(zx.normal, zx.direction);
}

/// Mean of both directions: where bonds carry shear forces at rest, Mindlin's law loads and unloads with different stiffness.
double quasistatic_modulus(const Network& network, const ContactModel& model) {
    double sum = 0;
    for (const double to : {strain, -strain}) {
        const RampOptions options{.strain = to, .steps = 1, .solver = {.orientation = zx}};
        const RampResponse ramp = shear_to(network.packing, network.bonds, model, options);
        sum += ramp.secant_modulus(ramp.points.size() - 1, zx);
    }
    return 0.5 * sum;
}

/// Of the fundamental: what is left of the motion of the relaxation does not enter.
double explicit_modulus(const Network& network, const ContactModel& model) {
    RheometerOptions options;
    options.model = model;
    options.boundary = RheometerBoundary::periodic;
    options.amplitude = strain;
    options.oscillations = 1;
    options.steps_per_oscillation = 12000;
    options.compare_with_rest = false;
    return run_rheometer(network.packing, network.bonds, options, {zx}).runs[0].oscillations[0].fundamental_storage;
}

void expect_agreement(const Network& network, const ContactModel& model) {
    const double linear = linear_modulus(network, model);
    EXPECT_NEAR(quasistatic_modulus(network, model) / linear, 1, 0.01);
    EXPECT_NEAR(explicit_modulus(network, model) / linear, 1, 0.01);
}

TEST(ContactLaws, AdhesiveContactsByThreeMethods) {
    expect_agreement(disordered(), {.young_modulus = 1e9, .poisson_ratio = 0.3, .work_of_adhesion = 0.05});
}

/// The prestress of the bonds as found is not in balance: equilibria and steps begin where the network has come to rest. Without
/// moments it would not be stable under pressure, which the linear solver says.
TEST(ContactLaws, PrestressedSpringsByThreeMethods) {
    ContactModel model{.normal_stiffness = 100, .shear_stiffness = 10, .prestress = 1e-8};
    EXPECT_THROW(linear_modulus(disordered(), model), std::runtime_error);
    model.bending_stiffness = model.twisting_stiffness = 1e-13;
    expect_agreement(disordered(), model);
}

/// In a crystal the prestress is in balance as found.
TEST(ContactLaws, PrestressedMindlinCrystalByThreeMethods) {
    const Packing packing = testing::make_lattice(testing::face_centred_cubic(), 4, 4, 4);
    const Network crystal{packing, find_contacts(packing, 0.01)};
    expect_agreement(crystal, {.young_modulus = 1e9, .poisson_ratio = 0.3, .prestress = 1e-8});
}

/// Without order the network comes to rest with other forces, and so other stiffnesses, than those given: the linear solver, which
/// takes every bond to carry the prestress, is about a tenth stiffer. The two that look for the rest agree.
TEST(ContactLaws, PrestressedMindlinDisorderByTwoMethods) {
    const ContactModel model{
        .bending_stiffness = 1e-13, .twisting_stiffness = 1e-13, .young_modulus = 1e9, .poisson_ratio = 0.3, .prestress = 1e-8};
    const double modulus = quasistatic_modulus(disordered(), model);
    EXPECT_NEAR(explicit_modulus(disordered(), model) / modulus, 1, 0.01);
    EXPECT_NEAR(linear_modulus(disordered(), model) / modulus, 1.09, 0.03);
}

}  // namespace
}  // namespace coagula::mechanics
