// SPDX-License-Identifier: GPL-3.0-or-later
// What plates do to the linear modulus: a beam, a crystal that becomes taller, and the explicit rheometer.
#include <coagula/common/random.hpp>
#include <coagula/mechanics/plate_stiffening.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "support/lattices.hpp"

#include "networks.hpp"

namespace coagula::mechanics {
namespace {

/// A straight chain of touching spheres along z, one through the whole cell.
Packing chain(int particles, double radius) {
    Packing packing;
    packing.cell = Cell::periodic({6 * radius, 6 * radius, 2 * radius * particles});
    packing.positions.resize(3, particles);
    for (int k = 0; k < particles; ++k) {
        packing.positions.col(k) << 3 * radius, 3 * radius, (2 * k + 1) * radius;
    }
    packing.radii = Eigen::VectorXd::Constant(particles, radius);
    return packing;
}

/// Force on the end of a clamped chain over the displacement of that end: bond k carries the force F and the moment F (L/2 - z_k),
/// and the angles that these bend it by add up to the turns of the particles.
double stiffness_of_beam(int bonds, double radius, double shear, double bending) {
    const double length = 2 * radius * bonds;
    double turn = 0;
    double displacement = 0;
    for (int k = 0; k < bonds; ++k) {
        const double height = (2 * k + 1) * radius;
        const double next = turn + (0.5 * length - height) / bending;
        displacement += 1 / shear + radius * (turn + next);
        turn = next;
    }
    return 1 / displacement;
}

TEST(PlateStiffening, HoldsAChainAsAClampedBeam) {
    const double radius = 0.5;
    const ContactTangent tangent{.normal = 50, .shear = 5, .bending = 2, .twisting = 1};
    for (const int particles : {3, 7}) {
        const Packing packing = chain(particles, radius);
        const ContactNetwork bonds = find_contacts(packing, 0.01);
        LinearOptions options;
        options.bond_tangents = testing::alike(bonds, tangent);
        const LinearResponse periodic = solve_linear(packing, bonds, options);
        const auto found = plate_stiffening(packing, bonds, periodic, {{2, 0}, {2, 1}, {0, 2}}, 1);
        const double height = packing.cell.lengths().z();
        const double area = packing.cell.volume() / height;
        const double expected = stiffness_of_beam(particles + 1, radius, tangent.shear, tangent.bending) * height / area;
        EXPECT_NEAR(found[0].between_plates / expected, 1, 1e-8);
        EXPECT_NEAR(found[1].between_plates / expected, 1, 1e-8);
        EXPECT_NEAR(found[2].between_plates, 0, 1e-8 * expected);  // nothing reaches from plate to plate
        EXPECT_TRUE(std::isnan(found[2].ratio()) || found[2].ratio() < 1e-6);
    }
}

/// Springs that join the sample to the plates are strained as well, which makes a stiff crystal softer; the rest is as without
/// plates: the effect goes as one over the height.
TEST(PlateStiffening, FallsAsTheHeightOfACrystalGrows) {
    const auto effect = [](int cells) {
        const Packing packing = testing::make_lattice(testing::face_centred_cubic(), 2, 2, cells);
        const ContactNetwork bonds = find_contacts(packing, 0.01);
        return cells * (plate_stiffening(packing, bonds, solve_linear(packing, bonds), {{2, 0}})[0].ratio() - 1);
    };
    EXPECT_LT(effect(4), -0.1);
    EXPECT_NEAR(effect(16) / effect(8), 1, 0.1);
}

/// Second method: explicit steps, then minimisation at the peak, with plates mounted for every orientation.
TEST(PlateStiffening, AgreesWithTheExplicitRheometer) {
    Packing packing = testing::make_lattice(testing::body_centred_cubic(), 3, 4, 5);
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d shift = 4e-8 * random_uniform(1, RandomPurpose::test, 0, static_cast<std::uint64_t>(particle));
        packing.positions.col(particle) = packing.cell.wrap(packing.positions.col(particle) + shift);
    }
    const ContactNetwork bonds = find_contacts(packing, 0.08);
    RheometerOptions options;
    options.amplitude = 1e-6;
    options.oscillations = 1;
    options.steps_per_oscillation = 4800;
    const std::vector<ShearOrientation> orientations{{2, 0}, {0, 1}, {1, 2}};
    const RheometerResult measured = run_rheometer(packing, bonds, options, orientations);
    const auto found = plate_stiffening(packing, bonds, solve_linear(packing, bonds), orientations);
    for (std::size_t k = 0; k < orientations.size(); ++k) {
        EXPECT_NEAR(found[k].between_plates / measured.runs[k].rest_modulus, 1, 0.005);
        EXPECT_GT(std::abs(found[k].ratio() - 1), 0.05);
    }
}

/// Direct and iterative.
TEST(PlateStiffening, DoesNotDependOnTheSolver) {
    const Packing packing = testing::random_spheres(160, 9.7, 1);
    const ContactNetwork bonds = find_contacts(packing, 0.5);
    const LinearResponse periodic = solve_linear(packing, bonds);
    const auto by = [&](LinearSolver solver) {
        LinearOptions options;
        options.solver = solver;
        options.modulus_tolerance = 1e-8;
        return plate_stiffening(packing, bonds, periodic, {{1, 0}}, 3, options)[0];
    };
    EXPECT_NEAR(by(LinearSolver::iterative).between_plates / by(LinearSolver::direct).between_plates, 1, 1e-6);
}

TEST(PlateStiffening, RefusesWhatHasNoPlates) {
    Packing packing = testing::make_lattice(testing::simple_cubic(), 3, 3, 3);
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const LinearResponse periodic = solve_linear(packing, bonds);
    EXPECT_THROW(plate_stiffening(packing, bonds, periodic, {{2, 0}}, 0), std::invalid_argument);
    EXPECT_THROW(plate_stiffening(packing, bonds, {}, {{2, 0}}), std::invalid_argument);
    packing.cell = Cell::open({0, 0, 0}, {1, 1, 1});
    EXPECT_THROW(plate_stiffening(packing, bonds, periodic, {{2, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
