// SPDX-License-Identifier: GPL-3.0-or-later
// The floppy modes that the linear solver counts are those of the rigidity matrix.
#include <coagula/characterize/rigidity.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/linear.hpp>

#include "networks.hpp"
#include "solvers/load_bearing.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

/// The linear solver counts the modes of what can carry load; each bond that it leaves aside had three independent constraints.
void expect_equal_counts(const Packing& packing, const ContactNetwork& bonds) {
    const LinearResponse response = solve_linear(packing, bonds);
    const characterize::Rigidity rigidity = characterize::measure_rigidity(packing, bonds);
    const auto aside = bonds.size() - static_cast<Index>(find_load_bearing(bonds).bond.size());
    EXPECT_EQ(rigidity.floppy_modes, response.floppy_modes + 6 * response.rattlers - 3 * aside);
    EXPECT_GT(response.floppy_modes, 0);
}

TEST(ModeCounts, AreThoseOfTheRigidityMatrix) {
    const Packing random = testing::random_spheres(120, 10.0, 1.0e-6, 21);
    expect_equal_counts(random, find_contacts(random, 0.02));
    generators::VoidExpansionOptions options;
    options.particles = 400;
    options.voids = 400;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(400, 0.25e-6);
    const Packing expanded = generators::expand_voids(options).packing;
    expect_equal_counts(expanded, find_contacts(expanded, 0.01));
}

}  // namespace
}  // namespace coagula::mechanics
