// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/plausibility.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace coagula::characterize {
namespace {

/// By comparing each pair in 27 images.
Eigen::VectorXd nearest_by_brute_force(const Packing& packing) {
    Eigen::VectorXd nearest = Eigen::VectorXd::Constant(packing.size(), std::numeric_limits<double>::infinity());
    for (Index i = 0; i < packing.size(); ++i) {
        for (Index j = 0; j < packing.size(); ++j) {
            for (int image = 0; image < (packing.cell.is_periodic() ? 27 : 1); ++image) {
                const Eigen::Vector3d shift = packing.cell.is_periodic()
                                                  ? Eigen::Vector3d(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1)
                                                  : Eigen::Vector3d(Eigen::Vector3d::Zero());
                const double distance =
                    (packing.positions.col(j) - packing.positions.col(i) + shift.cwiseProduct(packing.cell.lengths())).norm();
                if (i != j || distance > 0) {
                    nearest[i] = std::min(nearest[i], distance / (packing.radii[i] + packing.radii[j]));
                }
            }
        }
    }
    return nearest;
}

Packing random_spheres(Index particles, bool periodic, double largest_radius) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    Packing packing{periodic ? Cell::periodic({1, 2, 3}) : Cell::open({0, 0, 0}, {1, 2, 3}), Eigen::Matrix3Xd(3, particles),
                    Eigen::VectorXd(particles)};
    for (Index i = 0; i < particles; ++i) {
        packing.positions.col(i) << uniform(random), 2 * uniform(random), 3 * uniform(random);
        packing.radii[i] = largest_radius * (0.05 + uniform(random));
    }
    return packing;
}

TEST(Plausibility, NearestDistancesAreThoseOfAllPairs) {
    for (const bool periodic : {true, false}) {
        for (const double radius : {1e-4, 0.02, 0.2}) {
            for (const Index particles : {2, 5, 60}) {
                const Packing packing = random_spheres(particles, periodic, radius);
                EXPECT_TRUE(nearest_reduced_distances(packing).isApprox(nearest_by_brute_force(packing), 1e-12))
                    << particles << " particles, radius " << radius << (periodic ? ", periodic" : ", open");
            }
        }
    }
}

TEST(Plausibility, ASingleSphereMeetsItsImageOrNothing) {
    const Packing packing{Cell::periodic({4, 5, 6}), Eigen::Vector3d(1, 1, 1), Eigen::VectorXd::Constant(1, 0.5)};
    EXPECT_DOUBLE_EQ(nearest_reduced_distances(packing)[0], 4);
    const Packing open{Cell::open({0, 0, 0}, {4, 5, 6}), Eigen::Vector3d(1, 1, 1), Eigen::VectorXd::Constant(1, 0.5)};
    EXPECT_TRUE(std::isinf(nearest_reduced_distances(open)[0]));
    EXPECT_TRUE(std::isnan(judge_plausibility(open).median));
}

TEST(Plausibility, UnequalSpheresMayBeDenserThanEqualOnes) {
    // A simple cubic lattice of touching spheres with a smaller one in each hole fills 0.729, the same with overlaps of 4 % more.
    Packing packing{Cell::periodic({2, 2, 2}), Eigen::Matrix3Xd(3, 16), Eigen::VectorXd(16)};
    for (int k = 0; k < 8; ++k) {
        packing.positions.col(k) << k % 2, k / 2 % 2, k / 4;
        packing.positions.col(8 + k) = packing.positions.col(k).array() + 0.5;
        packing.radii[k] = 0.52;
        packing.radii[8 + k] = 0.37;
    }
    const Plausibility found = judge_plausibility(packing);
    EXPECT_GT(found.volume_fraction, 0.75);
    EXPECT_TRUE(found.warnings.empty()) << found.warnings[0];
}

}  // namespace
}  // namespace coagula::characterize
