// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/coordination.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

namespace coagula::characterize {
namespace {

/// Particles of radius 0.5 at the given centres in a periodic cube of edge 20.
Packing particles_at(const std::vector<Eigen::Vector3d>& centres) {
    Packing packing;
    packing.cell = Cell::periodic({20, 20, 20});
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(centres.front().data(), 3, std::ssize(centres));
    packing.radii = Eigen::VectorXd::Constant(packing.size(), 0.5);
    return packing;
}

TEST(Coordination, OfCrystals) {
    EXPECT_EQ(measure_coordination(test::simple_cubic({3, 3, 4}, 1)).mean, 6);
    EXPECT_EQ(measure_coordination(test::body_centred({3, 3, 3}, 1)).mean, 8);
    EXPECT_EQ(measure_coordination(test::face_centred({2, 3, 2}, 1)).mean, 12);
    EXPECT_EQ(measure_coordination(test::face_centred({2, 2, 2}, 1), {.contact_tolerance = 0.5}).mean,
              18);  // second shell at sqrt(2)
}

TEST(Coordination, CountsContactsWithOwnImages) {
    const Coordination coordination = measure_coordination(test::simple_cubic({1, 1, 1}, 1));
    EXPECT_EQ(coordination.mean, 6);
    EXPECT_EQ(coordination.mean_without_rattlers, 6);
    EXPECT_EQ(coordination.rattler_fraction, 0);
}

TEST(Coordination, RemovesRattlersAgainAndAgain) {
    // A ring of four with a tail of two, a pair, and one alone: only the ring carries.
    const Packing packing =
        particles_at({{5, 5, 5}, {6, 5, 5}, {6, 6, 5}, {5, 6, 5}, {7, 5, 5}, {8, 5, 5}, {12, 12, 12}, {13, 12, 12}, {1, 1, 1}});
    const Coordination coordination = measure_coordination(packing);
    EXPECT_DOUBLE_EQ(coordination.mean, 14.0 / 9);
    EXPECT_DOUBLE_EQ(coordination.mean_all, coordination.mean);
    EXPECT_DOUBLE_EQ(coordination.rattler_fraction, 5.0 / 9);
    EXPECT_DOUBLE_EQ(coordination.mean_without_rattlers, 2);
    EXPECT_DOUBLE_EQ(coordination.below_three_fraction, 8.0 / 9);
    EXPECT_EQ(coordination.inner_particles, 9);
    EXPECT_EQ(coordination.counts, (Eigen::VectorXi(9) << 2, 3, 2, 2, 2, 1, 1, 1, 0).finished());
    EXPECT_EQ(coordination.histogram, (Eigen::VectorXi(4) << 1, 3, 4, 1).finished());
}

TEST(Coordination, AllRattlers) {
    const Coordination coordination = measure_coordination(particles_at({{5, 5, 5}, {6, 5, 5}, {15, 6, 5}}));
    EXPECT_EQ(coordination.rattler_fraction, 1);
    EXPECT_EQ(coordination.mean_without_rattlers, 0);
    EXPECT_DOUBLE_EQ(coordination.mean, 2.0 / 3);
}

TEST(Coordination, OfOpenPackingsIsThatOfTheInnerPart) {
    Packing packing = test::face_centred({6, 6, 6}, 1);
    packing.cell = Cell::open(packing.cell.origin(), packing.cell.lengths());
    const Coordination coordination = measure_coordination(packing);
    EXPECT_GT(coordination.inner_particles, 50);
    EXPECT_EQ(coordination.mean, 12);
    EXPECT_LT(coordination.mean_all, 11);
}

TEST(Coordination, OfATinyOpenPackingIsThatOfAllParticles) {
    Packing packing = particles_at({{5, 5, 5}, {6, 5, 5}});
    packing.cell = Cell::open({0, 0, 0}, {20, 20, 20});
    const Coordination coordination = measure_coordination(packing);
    EXPECT_EQ(coordination.inner_particles, 0);
    EXPECT_EQ(coordination.mean, 1);
}

TEST(Coordination, RefusesBadInput) {
    EXPECT_THROW(measure_coordination(Packing{}), std::invalid_argument);
    EXPECT_THROW(measure_coordination(particles_at({{5, 5, 5}}), {.contact_tolerance = -2}), std::invalid_argument);
    EXPECT_THROW(measure_coordination(particles_at({{5, 5, 5}, {5, 5, 5}})), std::invalid_argument);
}

TEST(Overlaps, AreFractionsOfTheSumOfRadii) {
    Packing packing = particles_at({{5, 5, 5}, {5.9, 5, 5}, {5, 5.7, 5}, {12, 12, 12}, {13.001, 12, 12}});
    const Overlaps overlaps = measure_overlaps(packing);
    EXPECT_EQ(overlaps.pairs, 2);
    EXPECT_NEAR(overlaps.mean, 0.2, 1e-14);
    EXPECT_NEAR(overlaps.rms, std::sqrt(0.05), 1e-14);
    EXPECT_NEAR(overlaps.max, 0.3, 1e-14);
    packing.radii.setConstant(0.3);
    const Overlaps none = measure_overlaps(packing);
    EXPECT_EQ(none.pairs, 0);
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.rms, 0);
    EXPECT_EQ(none.max, 0);
}

}  // namespace
}  // namespace coagula::characterize
