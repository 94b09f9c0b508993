// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines in closed form, the modulus in proportion to the stiffness, the stiffness that matches measured moduli.
#include <coagula/mechanics/stiffness_series.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "networks.hpp"

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

TEST(StraightLine, ClosedForm) {
    const Eigen::Vector4d x(1, 2, 3, 4);
    const Eigen::Vector4d y(2, 3, 5, 6);
    const StraightLine line = fit_line(x, y);  // residuals 0.1, -0.3, 0.3, -0.1
    EXPECT_NEAR(line.slope, 1.4, 1e-14);
    EXPECT_NEAR(line.intercept, 0.5, 1e-14);
    EXPECT_NEAR(line.rms_residual, std::sqrt(0.2 / 4), 1e-14);
    EXPECT_NEAR(line.slope_stderr, std::sqrt(0.1 / 5), 1e-14);
    EXPECT_NEAR(line.intercept_stderr, std::sqrt(0.1 * (0.25 + 6.25 / 5)), 1e-14);
    const StraightLine proportional = fit_line_through_origin(x, y);  // 47 / 30
    EXPECT_NEAR(proportional.slope, 47.0 / 30, 1e-14);
    EXPECT_EQ(proportional.intercept, 0);
    EXPECT_NEAR(proportional.slope_stderr, std::sqrt((74 - 47.0 * 47 / 30) / 3 / 30), 1e-12);
}

TEST(StraightLine, PointsThatGiveNone) {
    EXPECT_THROW(fit_line(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 2, 3)), std::invalid_argument);
    EXPECT_THROW(fit_line(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1)), std::invalid_argument);
    EXPECT_THROW(fit_line(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, unset)), std::invalid_argument);
    EXPECT_THROW(fit_line_through_origin(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 2)), std::invalid_argument);
    EXPECT_TRUE(std::isnan(fit_line(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 3)).slope_stderr));
}

StiffnessSeriesOptions five_stiffnesses(double ratio = 10) {
    return {.normal_stiffness = Eigen::VectorXd::LinSpaced(5, 50, 150), .stiffness_ratio = ratio};
}

/// Linear springs in a fixed ratio have one scale: the modulus is proportional to it.
TEST(StiffnessSeries, ModulusIsProportionalToStiffness) {
    const Packing packing = random_spheres(200, 9, 0.25e-6);
    const ContactNetwork bonds = find_contacts(packing, 0.2);
    const StiffnessSeries series = measure_stiffness_series(packing, bonds, five_stiffnesses());
    ASSERT_GT(series.modulus[0], 1e3);
    EXPECT_TRUE(series.carries_shear);
    EXPECT_TRUE(series.shear_stiffness.isApprox(series.normal_stiffness / 10, 1e-15));
    for (Index k = 0; k < 5; ++k) {
        const double scale = series.normal_stiffness[k] / series.normal_stiffness[0];
        EXPECT_NEAR(series.modulus[k] / (scale * series.modulus[0]), 1, 1e-9);
        EXPECT_NEAR(series.modulus_deviation[k] / (scale * series.modulus_deviation[0]), 1, 1e-7);
    }
    EXPECT_NEAR(series.line.slope / series.line_through_origin.slope, 1, 1e-8);
    EXPECT_NEAR(series.line.intercept / series.modulus[0], 0, 1e-8);
}

/// Each value is that of solve_linear, and the ratio of the springs matters: it is not a scale.
TEST(StiffnessSeries, ValuesAreThoseOfTheLinearResponse) {
    const Packing packing = random_spheres(200, 9, 0.25e-6);
    const ContactNetwork bonds = find_contacts(packing, 0.2);
    const StiffnessSeries series = measure_stiffness_series(packing, bonds, five_stiffnesses(4));
    LinearOptions options;
    options.normal_stiffness = 125;
    options.shear_stiffness = 125.0 / 4;
    const LinearResponse response = solve_linear(packing, bonds, options);
    EXPECT_EQ(series.modulus[3], response.mean_shear_modulus());
    EXPECT_EQ(series.modulus_deviation[3], response.shear_modulus_deviation());
    EXPECT_EQ(series.contacts, bonds.size());
    EXPECT_EQ(series.rattlers, response.rattlers);
    const StiffnessSeries softer = measure_stiffness_series(packing, bonds, five_stiffnesses(40));
    EXPECT_LT(softer.modulus[3], 0.95 * series.modulus[3]);
}

/// A straight row of spheres around the box resists a pull, but no shear.
TEST(StiffnessSeries, RowOfSpheresCarriesNoShear) {
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(4e-6));
    packing.positions = Eigen::Matrix3Xd::Constant(3, 4, 1e-6);
    packing.positions.row(0) << 0, 1e-6, 2e-6, 3e-6;
    packing.radii = Eigen::VectorXd::Constant(4, 0.5e-6);
    const StiffnessSeries series = measure_stiffness_series(packing, find_contacts(packing, 0.01), five_stiffnesses());
    EXPECT_EQ(series.contacts, 4);
    EXPECT_FALSE(series.carries_shear);
}

TEST(StiffnessSeries, RefusesImpossibleSeries) {
    const Packing packing = random_spheres(20, 4, 0.25e-6);
    const ContactNetwork bonds = find_contacts(packing, 0.2);
    const auto refused = [&](const Eigen::VectorXd& stiffness, double ratio) {
        EXPECT_THROW(measure_stiffness_series(packing, bonds, {.normal_stiffness = stiffness, .stiffness_ratio = ratio}),
                     std::invalid_argument);
    };
    refused(Eigen::VectorXd::Ones(1), 10);
    refused(Eigen::Vector2d(2, 1), 10);
    refused(Eigen::Vector2d(0, 1), 10);
    refused(Eigen::Vector2d(1, 2), 0);
    refused(Eigen::Vector2d(1, unset), 10);
    StiffnessSeriesOptions own_stiffness = five_stiffnesses();
    own_stiffness.linear.bond_tangents.resize(1);
    EXPECT_THROW(measure_stiffness_series(packing, bonds, own_stiffness), std::invalid_argument);
}

TEST(StiffnessSeries, CanBeCancelled) {
    const Packing packing = random_spheres(200, 9, 0.25e-6);
    const Progress impatient([](std::string_view, double fraction, std::string_view) { return fraction < 0.3; });
    EXPECT_THROW(measure_stiffness_series(packing, find_contacts(packing, 0.2), five_stiffnesses(), impatient), Cancelled);
}

TEST(StiffnessCalibration, MatchesEachAndAll) {
    const Eigen::Vector2d slope(1e4, 2e4);
    const StiffnessCalibration exact = calibrate_stiffness(slope, Eigen::Vector2d(0.8e6, 1.6e6));
    EXPECT_TRUE(exact.matching.isApprox(Eigen::Vector2d(80, 80), 1e-14));
    EXPECT_NEAR(exact.common, 80, 1e-12);
    EXPECT_NEAR(exact.difference_at_common.norm(), 0, 1e-14);
    // 1e4 * 1e6 + 2e4 * 1.5e6 over 5e8
    const StiffnessCalibration apart = calibrate_stiffness(slope, Eigen::Vector2d(1e6, 1.5e6));
    EXPECT_TRUE(apart.matching.isApprox(Eigen::Vector2d(100, 75), 1e-14));
    EXPECT_NEAR(apart.common, 80, 1e-12);
    EXPECT_TRUE(apart.modulus_at_common.isApprox(Eigen::Vector2d(0.8e6, 1.6e6), 1e-14));
    EXPECT_TRUE(apart.difference_at_common.isApprox(Eigen::Vector2d(-0.2, 0.1 / 1.5), 1e-13));
    EXPECT_NEAR(apart.common_stderr, std::sqrt((4e10 + 1e10) / 5e8), 1e-12);
    EXPECT_TRUE(std::isnan(calibrate_stiffness(slope.head(1), Eigen::VectorXd::Ones(1)).common_stderr));
}

TEST(StiffnessCalibration, RefusesWhatHasNoStiffness) {
    EXPECT_THROW(calibrate_stiffness(Eigen::Vector2d(1, 2), Eigen::VectorXd::Ones(1)), std::invalid_argument);
    EXPECT_THROW(calibrate_stiffness(Eigen::Vector2d(0, 2), Eigen::Vector2d(1, 1)), std::invalid_argument);
    EXPECT_THROW(calibrate_stiffness(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, -1)), std::invalid_argument);
    EXPECT_THROW(calibrate_stiffness({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
