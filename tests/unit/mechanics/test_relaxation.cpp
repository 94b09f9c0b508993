// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/relaxation.hpp>

#include "networks.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

/// Root mean square over the bonds of their stretch, in mean diameters.
double rms_stretch(const Packing& packing, const ContactNetwork& bonds) {
    double sum = 0;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const double rest = packing.radii[bonds.ends(0, bond)] + packing.radii[bonds.ends(1, bond)];
        const double stretch = bonds.branch.col(bond).norm() / rest - 1;
        sum += stretch * stretch;
    }
    return std::sqrt(sum / static_cast<double>(bonds.size()));
}

TEST(Relaxation, TwoBondedSpheresComeToTouch) {
    for (const RelaxationScheme scheme : {RelaxationScheme::minimise, RelaxationScheme::stopped_steps}) {
        Packing packing = coagula::testing::random_spheres(2, 20.0, 1.0e-6);
        packing.positions.col(0) = Eigen::Vector3d(1e-7, 5e-6, 5e-6);
        packing.positions.col(1) = Eigen::Vector3d(18.12e-6, 5e-6, 5e-6);  // through the boundary: 1.98 radii apart
        RelaxationOptions options;
        options.scheme = scheme;
        options.tolerance = 1e-9;
        const auto rest = relax(packing, find_contacts(packing, 0.05), options);
        EXPECT_NEAR(rest.bonds.branch.col(0).norm(), 2.0e-6, 1e-14);
        EXPECT_NEAR(rest.displacement.col(0)[0], -rest.displacement.col(1)[0], 1e-18);
    }
}

TEST(Relaxation, BondsKeepTheirPartnersAndLoseTheirStretch) {
    const Packing packing = coagula::testing::random_spheres(300, 15.0, 1.0e-6, 9);
    const ContactNetwork bonds = find_contacts(packing, 0.02);
    const auto rest = relax(packing, bonds);
    EXPECT_LT(rest.rms_force, 1e-7);
    EXPECT_TRUE(rest.bonds.ends == bonds.ends);
    EXPECT_LT(rms_stretch(rest.packing, rest.bonds), 0.5 * rms_stretch(packing, bonds));
}

TEST(Relaxation, RefusesImpossibleOptions) {
    const Packing packing = coagula::testing::random_spheres(10, 10.0, 1.0e-6);
    RelaxationOptions options;
    options.normal_stiffness = 0;
    EXPECT_THROW(relax(packing, find_contacts(packing, 0.01), options), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
