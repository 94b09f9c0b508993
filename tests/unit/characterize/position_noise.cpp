// SPDX-License-Identifier: GPL-3.0-or-later
// Noise of the coordinates: what it does to a lattice, and the noise that overlaps imply.
#include <coagula/characterize/position_noise.hpp>

#include "named_results.hpp"
#include "test_packings.hpp"

#include <gtest/gtest.h>

namespace coagula::characterize {
namespace {

using test::scalar;

TEST(PositionNoise, IsTheOneThatOverlapsImply) {
    // Separations of touching spheres vary by sqrt(2) times the noise, half of them inward.
    const Packing packing = test::face_centred({6, 6, 6}, 1);
    const PositionNoise noise{Eigen::Vector3d::Constant(0.004), 4};
    EXPECT_NEAR(measure_overlaps(with_noise(packing, noise, 1, 0)).implied_noise, 0.004, 0.0003);
    EXPECT_LT(measure_overlaps(packing).implied_noise, 1e-12);
}

TEST(PositionNoise, ActsAlongTheAxesItIsGivenFor) {
    const Packing packing = test::lattice({{.5, .5, .5}}, 4, {10, 10, 10}, 1);
    const Eigen::Matrix3Xd shifts = with_noise(packing, {{0, 0.02, 0.1}, 2}, 3, 1).positions - packing.positions;
    const Eigen::Vector3d rms = (shifts.rowwise().squaredNorm() / 1000).cwiseSqrt();
    EXPECT_EQ(rms[0], 0);
    EXPECT_NEAR(rms[1], 0.02, 0.002);
    EXPECT_NEAR(rms[2], 0.1, 0.01);
}

TEST(PositionNoise, MovesScalarsAsItsVariance) {
    // Contacts within 1 % are lost; bond order of a lattice falls with the square of the noise.
    const Packing packing = test::face_centred({4, 4, 4}, 1);
    const auto shift = [&](double deviation, const std::string& measure, const std::string& name) {
        const MeasureResult measured = run_measures(MeasureInput(packing), {measure});
        const MeasureResult found =
            measure_noise_shifts(packing, measured, {Eigen::Vector3d::Constant(deviation), 4}, {}, {measure}, 1);
        EXPECT_GT(scalar(found, "noise/shift_error/" + name), 0);
        return scalar(found, "noise/shift/" + name);
    };
    // A pair stays within 1 % if the noise sqrt(2) 0.01 of its distance is below 0.02: with probability Phi(sqrt(2)) = 0.92.
    EXPECT_NEAR(shift(0.01, "coordination", "coordination"), -12 * 0.0786, 0.06);
    const double small = shift(0.02, "bond_order", "bond_order/q6");
    EXPECT_LT(small, 0);
    EXPECT_NEAR(shift(0.04, "bond_order", "bond_order/q6") / small, 4, 0.5);
}

TEST(PositionNoise, RefusesBadInput) {
    const Packing packing = test::face_centred({2, 2, 2}, 1);
    const MeasureResult none;
    EXPECT_THROW(measure_noise_shifts(packing, none, {Eigen::Vector3d::Constant(-1), 4}, {}, {}, 1), std::invalid_argument);
    EXPECT_THROW(measure_noise_shifts(packing, none, {Eigen::Vector3d::Constant(0.1), 1}, {}, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
