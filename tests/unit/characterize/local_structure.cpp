// SPDX-License-Identifier: GPL-3.0-or-later
// Angles, common neighbours, distances and bond order of lattices and of the ideal gas.
#include <coagula/characterize/bond_order.hpp>
#include <coagula/characterize/local_structure.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;

/// Hexagonal close packing of touching spheres of radius 1 in its rectangular cell.
Packing hexagonal(int cells) {
    const double a = 2, b = 2 * std::sqrt(3.0), c = 2 * std::sqrt(8.0 / 3);
    const std::vector<Eigen::Vector3d> basis = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 1.0 / 6, 0.5}, {0, 2.0 / 3, 0.5}};
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d(2 * a, b, c) * cells);
    packing.positions.resize(3, Index{8} * cells * cells * cells);
    Index next = 0;
    for (int x = 0; x < 2 * cells; ++x) {
        for (int y = 0; y < cells; ++y) {
            for (int z = 0; z < cells; ++z) {
                for (const Eigen::Vector3d& site : basis) {
                    packing.positions.col(next++) = Eigen::Vector3d((x + site[0]) * a, (y + site[1]) * b, (z + site[2]) * c);
                }
            }
        }
    }
    packing.radii = Eigen::VectorXd::Ones(packing.size());
    return packing;
}

TEST(BondAngles, OfFccAreFour) {
    const BondAngles found = measure_bond_angles(test::face_centred({2, 3, 2}, 1), {.bins = 180});
    const auto share = [&](int degrees) {  // of the two bins around
        return (found.density[std::max(0, degrees - 1)] + (degrees < 180 ? found.density[degrees] : 0.0)) * pi / 180;
    };
    EXPECT_EQ(found.angles, 48 * 66);
    EXPECT_NEAR(share(60), 24.0 / 66, 1e-12);
    EXPECT_NEAR(share(90), 12.0 / 66, 1e-12);
    EXPECT_NEAR(share(120), 24.0 / 66, 1e-12);
    EXPECT_NEAR(share(180), 6.0 / 66, 1e-12);
    EXPECT_NEAR(found.mean * 180 / pi, (24 * 60 + 12 * 90 + 24 * 120 + 6 * 180) / 66.0, 1e-9);
    EXPECT_NEAR(found.below_equilateral, 24.0 / 66, 1e-12);
}

TEST(BondAngles, OfOneSphereThatTouchesItsImages) {
    EXPECT_NEAR(measure_bond_angles(test::simple_cubic({1, 1, 1}, 1)).mean * 180 / pi, (12 * 90 + 3 * 180) / 15.0, 1e-9);
}

TEST(BondAngles, WithoutContactsThereAreNone) {
    Packing apart = test::simple_cubic({3, 3, 3}, 1);
    apart.radii.setConstant(0.5);
    const BondAngles found = measure_bond_angles(apart);
    EXPECT_EQ(found.angles, 0);
    EXPECT_TRUE(found.density.isZero());
}

TEST(CommonNeighbours, NameTheLattices) {
    const CommonNeighbours fcc = measure_common_neighbours(test::face_centred({3, 3, 3}, 1));
    ASSERT_EQ(fcc.fraction.size(), 1U);
    EXPECT_NEAR(fcc.fraction.at({4, 2, 1}), 1, 1e-12);
    EXPECT_NEAR(fcc.mean, 4, 1e-12);
    EXPECT_EQ(fcc.fcc, 1);
    const CommonNeighbours hcp = measure_common_neighbours(hexagonal(3));
    EXPECT_EQ(hcp.hcp, 1);
    EXPECT_NEAR(hcp.fraction.at({4, 2, 2}), 0.5, 1e-12);
    const CommonNeighbours bcc = measure_common_neighbours(test::body_centred({3, 3, 3}, 1));
    EXPECT_EQ(bcc.bcc, 1);
    EXPECT_EQ(bcc.mean, 0);  // the eight that touch do not touch each other
    const CommonNeighbours none = measure_common_neighbours(test::random_spheres(500, {8, 8, 8}, 0.3, 0.5, 2));
    EXPECT_LT(none.fcc + none.hcp + none.bcc + none.icosahedral, 0.02);
}

TEST(CommonNeighbours, NameAnIcosahedron) {
    Packing packing;
    packing.cell = Cell::open({-3, -3, -3}, {6, 6, 6});
    packing.positions = Eigen::Matrix3Xd::Zero(3, 13);
    const double golden = std::numbers::phi;
    Index next = 1;
    for (const double one : {-1.0, 1.0}) {
        for (const double other : {-golden, golden}) {
            packing.positions.col(next++) << 0, one, other;
            packing.positions.col(next++) << one, other, 0;
            packing.positions.col(next++) << other, 0, one;
        }
    }
    packing.radii = Eigen::VectorXd::Constant(13, 1.0);
    const CommonNeighbours found = measure_common_neighbours(packing, {.contact_tolerance = 0.05});
    EXPECT_GT(found.fraction.at({5, 5, 5}), 0.2);  // of the twelve contacts of the one in the middle
}

TEST(NeighbourDistances, OfAnIdealGasAreThoseOfHertz) {
    const Packing packing = test::random_spheres(8000, {20, 20, 20}, 0.1, 0.1, 7);
    const NeighbourDistances found = measure_neighbour_distances(packing);
    for (Index k = 1; k <= 12; ++k) {  // (3 / (4 pi n))^(1/3) Gamma(k + 1/3) / Gamma(k)
        const auto order = static_cast<double>(k);
        const double expected = std::cbrt(3 / (4 * pi)) * std::tgamma(order + 1.0 / 3) / std::tgamma(order);
        EXPECT_NEAR(found.mean[k - 1], expected, 4 * found.mean_stderr[k - 1]) << k;
        EXPECT_LT(found.mean_stderr[k - 1], 0.01 * expected);
    }
    double misfit = 0;
    int bins = 0;
    const double width = found.distance[1] - found.distance[0];
    for (Index k = 0; k < found.distance.size(); ++k) {  // H(r) = 4 pi n r^2 exp(-4 pi n r^3 / 3)
        const double r = found.distance[k];
        const double expected = 4 * pi * r * r * std::exp(-4 * pi / 3 * r * r * r) * width * 8000;
        if (expected > 20) {
            misfit += std::pow(found.density[k] * width * 8000 - expected, 2) / expected;
            ++bins;
        }
    }
    EXPECT_GT(bins, 30);
    EXPECT_NEAR(misfit / bins, 1, 0.8);
}

TEST(NeighbourDistances, OfFcc) {
    const NeighbourDistances found = measure_neighbour_distances(test::face_centred({2, 2, 2}, 0.5), {.neighbours = 13});
    EXPECT_NEAR(found.mean[0], 1, 1e-12);
    EXPECT_NEAR(found.mean[11], 1, 1e-12);
    EXPECT_NEAR(found.mean[12], std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(found.mean_gap, 0, 1e-12);
    EXPECT_NEAR(found.spread, 0, 1e-7);
}

TEST(BondOrder, OfCubicLatticesIsThatOfTheirCells) {
    const BondOrder fcc = measure_bond_order(test::face_centred({2, 2, 3}, 1));
    EXPECT_NEAR(fcc.q4_mean, std::sqrt(7.0 / 192), 1e-9);    // 0.1909
    EXPECT_NEAR(fcc.q6_mean, std::sqrt(169.0 / 512), 1e-9);  // 0.5745
    EXPECT_EQ(fcc.facets, 12);
    const BondOrder cubic = measure_bond_order(test::simple_cubic({3, 3, 3}, 1));
    EXPECT_NEAR(cubic.q4_mean, std::sqrt(7.0 / 12), 1e-9);
    EXPECT_NEAR(cubic.q6_mean, std::sqrt(1.0 / 8), 1e-9);
    // The truncated octahedron: Y_lm of (1 1 1) and (1 0 0) in the cubic harmonics. Along (100) K4 = sqrt(7/12), K6 = sqrt(1/8);
    // along (111) K4 = -2/3 sqrt(7/12), K6 = 16/9 sqrt(1/8). Eight hexagons of area 3 sqrt(3) / 2 and six squares of area 1.
    const double hexagons = 8 * 3 * std::sqrt(3.0) / 2, squares = 6;
    const BondOrder bcc = measure_bond_order(test::body_centred({3, 2, 2}, 1));
    EXPECT_NEAR(bcc.q4_mean, std::sqrt(7.0 / 12) * std::abs(squares - 2.0 / 3 * hexagons) / (squares + hexagons), 1e-9);
    EXPECT_NEAR(bcc.q6_mean, std::sqrt(1.0 / 8) * (squares + 16.0 / 9 * hexagons) / (squares + hexagons), 1e-9);
    EXPECT_EQ(bcc.facets, 14);
    EXPECT_NEAR(bcc.q6_spread, 0, 1e-7);
}

TEST(BondOrder, HardlyChangesWhenParticlesAreMovedALittle) {
    Packing packing = test::face_centred({3, 3, 3}, 1);
    for (Index i = 0; i < packing.size(); ++i) {
        const auto noise = random_uniform(1, RandomPurpose::test, 2, static_cast<std::uint64_t>(i));
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i) + 1e-4 * noise);
    }
    EXPECT_NEAR(measure_bond_order(packing).q6_mean, std::sqrt(169.0 / 512), 1e-3);
}

}  // namespace
}  // namespace coagula::characterize
