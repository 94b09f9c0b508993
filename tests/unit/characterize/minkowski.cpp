// SPDX-License-Identifier: GPL-3.0-or-later
// Minkowski functionals against closed forms, the pore curve and each other.
#include <coagula/characterize/minkowski.hpp>
#include <coagula/characterize/pore_sizes.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coagula::characterize {
namespace {

using std::numbers::pi;

TEST(Minkowski, OfFccAreThoseOfSpheresAndLenses) {
    // While no three balls overlap: each ball of radius R minus half of twelve lenses. Two balls whose centres are 2 apart meet in
    // a circle of radius s = sqrt(R^2 - 1); their normals there differ by 2 asin(1 / R).
    const Minkowski found = measure_minkowski(test::face_centred({2, 2, 2}, 1), {.dilations = 40});
    const double density = 1 / (4 * std::sqrt(2.0));
    int compared = 0;
    for (Index k = 1; k < 40; ++k) {
        const double radius = 1 + found.dilation[k];
        if (radius > 2 / std::sqrt(3.0)) {
            continue;
        }
        const double cap = radius - 1;
        EXPECT_NEAR(found.volume_fraction[k],
                    density * (4 * pi / 3 * std::pow(radius, 3) - 12 * pi / 3 * cap * cap * (3 * radius - cap)), 1e-12);
        const double area = 4 * pi * radius * radius - 12 * 2 * pi * radius * cap;
        EXPECT_NEAR(found.surface[k], density * area, 1e-12);
        const double circles = 6 * 2 * pi * std::sqrt(radius * radius - 1) * 2 * std::asin(1 / radius);
        EXPECT_NEAR(found.mean_curvature[k], density * (area / radius - circles / 2), 1e-12);
        EXPECT_NEAR(found.euler_characteristic[k], density * (1 - 6), 1e-12);
        ++compared;
    }
    EXPECT_GT(compared, 10);
}

TEST(Minkowski, EulerCharacteristicCountsPartsTunnelsAndCavities) {
    // Spheres in a box so large that no image is near.
    const auto euler = [](const std::vector<Eigen::Vector3d>& centres, double radius) {
        Packing packing;
        packing.cell = Cell::periodic({40, 41, 42});
        packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(centres.front().data(), 3, std::ssize(centres)).array() + 20;
        packing.radii = Eigen::VectorXd::Constant(packing.size(), radius);
        return measure_minkowski(packing, {.dilations = 2}).euler_characteristic[0] * packing.cell.volume();
    };
    EXPECT_NEAR(euler({{0, 0, 0}, {2, 0.1, 0}, {4, 0, 0.1}}, 0.9), 3, 1e-9);
    EXPECT_NEAR(euler({{0, 0, 0}, {2, 0.1, 0}, {4, 0, 0.1}}, 1.1), 1, 1e-9);
    std::vector<Eigen::Vector3d> ring;
    for (int k = 0; k < 12; ++k) {
        ring.emplace_back(4 * std::cos(k * pi / 6), 4 * std::sin(k * pi / 6), 0.01 * (k % 3));
    }
    EXPECT_NEAR(euler(ring, 1.2), 0, 1e-9);
    std::vector<Eigen::Vector3d> shell;
    for (int k = 0; k < 200; ++k) {  // a Fibonacci sphere
        const double z = 1 - (2 * k + 1) / 200.0, turn = k * pi * (3 - std::sqrt(5.0));
        shell.emplace_back(5 * std::sqrt(1 - z * z) * std::cos(turn), 5 * std::sqrt(1 - z * z) * std::sin(turn), 5 * z);
    }
    EXPECT_NEAR(euler(shell, 1.5), 2, 1e-9);
    EXPECT_NEAR(euler(shell, 6), 1, 1e-9);
}

/// Of randomly placed balls of radius R (Mecke and Wagner, J. Stat. Phys. 64 (1991) 843).
struct BooleanModel {
    double volume, surface, curvature, euler;

    BooleanModel(double density, double radius) {
        const double s = density * 4 * pi * radius * radius, m = density * 4 * pi * radius;
        const double empty = std::exp(-density * 4 * pi / 3 * std::pow(radius, 3));
        volume = 1 - empty;
        surface = s * empty;
        curvature = (m - pi * pi / 32 * s * s) * empty;
        euler = (density - m * s / (4 * pi) + pi / 384 * s * s * s) * empty;
    }
};

TEST(Minkowski, OfAnIdealGasAreThoseOfMeckeAndWagner) {
    constexpr int samples = 12;
    constexpr Index steps = 30;
    Eigen::Array4d sum = Eigen::Array4d::Zero(), squares = Eigen::Array4d::Zero();
    Eigen::Array4d stated = Eigen::Array4d::Zero();
    for (std::uint64_t seed = 1; seed <= samples; ++seed) {
        const Minkowski found = measure_minkowski(test::random_spheres(600, {8, 9, 10}, 0.5, 0.5, seed), {.dilations = steps});
        const BooleanModel exact(600 / 720.0, 0.5);
        const Eigen::Array4d difference(found.volume_fraction[0] - exact.volume, found.surface[0] - exact.surface,
                                        found.mean_curvature[0] - exact.curvature, found.euler_characteristic[0] - exact.euler);
        sum += difference / samples;
        squares += difference.square() / samples;
        stated += Eigen::Array4d(found.volume_fraction_stderr, found.surface_stderr, found.mean_curvature_stderr,
                                 found.euler_characteristic_stderr) /
                  samples;
    }
    const Eigen::Array4d deviation = (squares - sum.square()).max(0.0).sqrt();
    EXPECT_TRUE((sum.abs() < 4 * deviation / std::sqrt(samples)).all()) << sum.transpose() << "; " << deviation.transpose();
    EXPECT_TRUE((stated / deviation > 0.5).all() && (stated / deviation < 2).all()) << (stated / deviation).transpose();
}

TEST(Minkowski, VolumeIsThatOfThePoreCurveAndSurfaceItsSlope) {
    const Packing equal = test::random_spheres(200, {5, 6, 7}, 0.4, 0.4, 5);
    const Packing unequal = test::random_spheres(100, {5, 4, 5}, 0.3, 0.6, 5);
    Packing open = equal;
    open.cell = Cell::open({0, 0, 0}, {5, 6, 7});
    for (const Packing& packing : {equal, unequal, open}) {
        const Minkowski found = measure_minkowski(packing, {.dilations = 21});
        const PoreSizes pores = measure_pores(packing, {.radii = 21});
        EXPECT_NEAR(found.dilation[20], pores.max, 1e-5 * pores.max);
        for (Index k = 0; k < 21; ++k) {
            EXPECT_NEAR(1 - found.volume_fraction[k], pores.void_fraction * pores.exclusion_probability[k], 1e-5) << k;
        }
        EXPECT_NEAR(found.volume / pores.volume, 1, 1e-9);
    }
    // Two close dilations, by growing the spheres.
    for (const Packing& packing : {equal, unequal}) {
        constexpr double step = 1e-5;
        Packing larger = packing, smaller = packing;
        larger.radii.array() += step;
        smaller.radii.array() -= step;
        const double slope = (measure_minkowski(larger, {.dilations = 2}).volume_fraction[0] -
                              measure_minkowski(smaller, {.dilations = 2}).volume_fraction[0]) /
                             (2 * step);
        EXPECT_NEAR(measure_minkowski(packing, {.dilations = 2}).surface[0], slope, 1e-6);
    }
}

TEST(Minkowski, UnequalPathAgreesWithEqualPath) {
    Packing packing = test::random_spheres(150, {5, 6, 7}, 0.4, 0.4, 6);
    const Minkowski equal = measure_minkowski(packing, {.dilations = 9});
    packing.radii[0] *= 1 + 1e-10;
    const Minkowski unequal = measure_minkowski(packing, {.dilations = 9});
    EXPECT_LT((equal.mean_curvature - unequal.mean_curvature).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((equal.euler_characteristic - unequal.euler_characteristic).head(8).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(equal.percolation_dilation, unequal.percolation_dilation, 1e-6);
}

TEST(Minkowski, RefuseBadInput) {
    EXPECT_THROW(measure_minkowski(test::simple_cubic({2, 2, 2}, 1), {.dilations = 1}), std::invalid_argument);
    Packing full = test::simple_cubic({2, 2, 2}, 1);
    full.radii.setConstant(2);
    EXPECT_THROW(measure_minkowski(full), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
