// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/inner_particles.hpp>

#include "pores/coverage.hpp"
#include "test_packings.hpp"

#include <coagula/characterize/pore_sizes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace coagula::characterize {
namespace {

Packing open(Packing packing) {
    packing.cell = Cell::open(packing.cell.origin(), packing.cell.lengths());
    return packing;
}

TEST(InnerParticles, AreAllOfAPeriodicPacking) {
    const std::vector<bool> inner = inner_particles(test::simple_cubic({2, 3, 2}, 1));
    EXPECT_EQ(std::count(inner.begin(), inner.end(), true), 12);
}

TEST(InnerParticles, LieTwoLayersBelowTheFaceOfASimpleCubicBlock) {
    // Circumspheres of the cubic cells have the radius sqrt(3) r0; one in the outermost layer of cells is centred r0 below the hull
    // and sticks out, one in the second layer, 3 r0 below, does not.
    const Packing packing = open(test::simple_cubic({6, 7, 8}, 1));
    const std::vector<bool> inner = inner_particles(packing);
    for (Index i = 0; i < packing.size(); ++i) {
        const Eigen::Array3d site = packing.positions.col(i).array() / 2;
        const bool expected = (site > 1.5).all() && site[0] < 3.5 && site[1] < 4.5 && site[2] < 5.5;
        EXPECT_EQ(inner[static_cast<std::size_t>(i)], expected) << site.transpose();
    }
}

/// The particles of a periodic packing inside or outside the cube |x - centre| < half_edge, as an open packing.
std::vector<Eigen::Vector3d> centres_of(const Packing& packing, const Eigen::Vector3d& centre, double half_edge, bool inside) {
    std::vector<Eigen::Vector3d> centres;
    for (Index i = 0; i < packing.size(); ++i) {
        if (((packing.positions.col(i) - centre).cwiseAbs().maxCoeff() < half_edge) == inside) {
            centres.emplace_back(packing.positions.col(i));
        }
    }
    return centres;
}

Packing open_packing(const std::vector<Eigen::Vector3d>& centres, double radius) {
    Packing packing;
    packing.cell = Cell::open({0, 0, 0}, {10, 10, 10});
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(centres.front().data(), 3, std::ssize(centres));
    packing.radii = Eigen::VectorXd::Constant(packing.size(), radius);
    return packing;
}

TEST(InnerParticles, NothingOutsideTheHullChangesTheirCells) {
    const Eigen::Vector3d middle = Eigen::Vector3d::Constant(5);
    std::vector<Eigen::Vector3d> centres = centres_of(test::random_spheres(3000, {10, 10, 10}, 0.6, 0.6, 9), middle, 3.5, true);
    const Packing alone = open_packing(centres, 0.6);
    const std::vector<bool> inner = inner_particles(alone);
    EXPECT_GT(std::count(inner.begin(), inner.end(), true), 200);
    const auto shell = centres_of(test::random_spheres(30000, {10, 10, 10}, 0.6, 0.6, 10), middle, 3.5, false);
    centres.insert(centres.end(), shell.begin(), shell.end());
    const Packing surrounded = open_packing(centres, 0.6);
    std::vector<char> counted(inner.begin(), inner.end());
    const Blocks all{Eigen::VectorXi::Zero(surrounded.size()), 1};
    const Eigen::Vector2d by_itself = cover_spheres(power_diagram(alone, alone.radii, counted), all);
    counted.resize(centres.size(), 0);
    const Eigen::Vector2d among_others = cover_spheres(power_diagram(surrounded, surrounded.radii, counted), all);
    EXPECT_NEAR(among_others[1] / by_itself[1], 1, 1e-12);
    EXPECT_NEAR(among_others[0] / by_itself[0], 1, 1e-12);
    EXPECT_LT(among_others[0] / among_others[1], 0.99);
}

TEST(InnerParticles, UnequalSpheresAreMeasuredInTheSameCells) {
    Packing packing = open(test::random_spheres(600, {6, 7, 6}, 0.3, 0.3, 13));
    const PoreSizes equal = measure_pores(packing, {.radii = 41});
    packing.radii[0] *= 1 + 1e-10;
    const PoreSizes unequal = measure_pores(packing, {.radii = 41, .tolerance = 0});
    EXPECT_EQ(unequal.inner_particles, equal.inner_particles);
    EXPECT_NEAR(unequal.volume, equal.volume, 1e-8);
    EXPECT_NEAR(unequal.max, equal.max, 1e-8);
    EXPECT_LT((unequal.exclusion_probability - equal.exclusion_probability).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(InnerParticles, NoneInSmallOpenPackings) {
    for (const Index count : {1, 2, 3, 4, 5, 20}) {
        const Packing packing = open(test::random_spheres(count, {9, 9, 9}, 0.4, 0.4, 12));
        const std::vector<bool> inner = inner_particles(packing);
        EXPECT_EQ(std::count(inner.begin(), inner.end(), true), 0) << count;
        EXPECT_THROW(measure_pores(packing), std::invalid_argument) << count;
    }
    EXPECT_THROW(measure_pores(open(test::simple_cubic({9, 9, 1}, 1))), std::invalid_argument);  // all in one plane
}

TEST(InnerParticles, OpenCrystalHasThePoresOfThePeriodicOne) {
    const Packing packing = test::face_centred({7, 7, 7}, 1);
    const PoreSizes periodic = measure_pores(packing);
    const PoreSizes inner = measure_pores(open(packing));
    EXPECT_NEAR(inner.void_fraction, periodic.void_fraction, 1e-11);
    EXPECT_LT((inner.exclusion_probability - periodic.exclusion_probability).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(inner.mean, periodic.mean, 1e-9);
    EXPECT_NEAR(inner.volume / static_cast<double>(inner.inner_particles), 4 * std::sqrt(2.0), 1e-10);
}

}  // namespace
}  // namespace coagula::characterize
