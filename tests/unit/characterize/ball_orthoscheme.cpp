// SPDX-License-Identifier: GPL-3.0-or-later
// The closed form for a ball and a right tetrahedron against numerical integration.
#include "geometry/ball_orthoscheme.hpp"

#include <coagula/common/random.hpp>

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace coagula::characterize {
namespace {

using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;

/// Integrates f over [0, end] piece by piece between its kinks.
template <class Function>
double integrate(Function&& f, double end, std::vector<double> kinks) {
    kinks.push_back(0);
    kinks.push_back(end);
    for (double& kink : kinks) {
        kink = std::isfinite(kink) ? std::clamp(kink, 0.0, end) : 0.0;
    }
    std::sort(kinks.begin(), kinks.end());
    double sum = 0;
    for (std::size_t k = 1; k < kinks.size(); ++k) {
        if (kinks[k] > kinks[k - 1]) {
            sum += Quadrature::integrate(f, kinks[k - 1], kinks[k], 12, 1e-10);
        }
    }
    return sum;
}

/// Cone over the triangle 0 < v < c u / b, 0 < u < b at distance a: integral of min(rho, ray)^3 / 3 over the solid angle.
double volume_by_quadrature(double a, double b, double c, double rho) {
    const double disc = std::sqrt(std::max(0.0, rho * rho - a * a));  // where the sphere meets the plane
    const auto strip = [&](double u) {
        const auto density = [&](double v) {
            const double ray = std::sqrt(a * a + u * u + v * v);
            return std::pow(std::min(rho, ray), 3) / 3 * a / (ray * ray * ray);
        };
        return integrate(density, c * u / b, {std::sqrt(std::max(0.0, disc * disc - u * u))});
    };
    return integrate(strip, b, {disc, disc * b / std::hypot(b, c)});
}

TEST(BallOrthoscheme, AgreesWithQuadratureInEveryRange) {
    for (std::uint64_t sample = 0; sample < 40; ++sample) {
        const Eigen::Vector3d edge = 0.05 + 2 * random_uniform(11, RandomPurpose::test, 0, sample).array();
        const double a = edge[0];
        const double d1 = std::hypot(a, edge[1]);
        const double d2 = std::hypot(d1, edge[2]);
        for (const double rho : {0.5 * a, 0.3 * a + 0.7 * d1, 0.9 * d1 + 0.1 * d2, 0.2 * d1 + 0.8 * d2, 1.1 * d2}) {
            EXPECT_NEAR(volume_inside_ball(a, edge[1], edge[2], rho), volume_by_quadrature(a, edge[1], edge[2], rho), 1e-8)
                << "a, b, c = " << edge.transpose() << ", rho = " << rho;
        }
    }
}

TEST(BallOrthoscheme, IsContinuousWhereTheCasesMeet) {
    const double a = 1.1, b = 0.7, c = 0.4;
    for (const double rho : {a, std::hypot(a, b), std::hypot(a, b, c)}) {
        const double slope_bound = 4 * std::numbers::pi * rho * rho;
        EXPECT_NEAR(volume_inside_ball(a, b, c, rho - 1e-9), volume_inside_ball(a, b, c, rho + 1e-9), 2e-9 * slope_bound);
    }
    EXPECT_DOUBLE_EQ(volume_inside_ball(a, b, c, 2), a * b * c / 6);
}

TEST(BallOrthoscheme, IsOddInEachEdge) {
    for (const double rho : {0.5, 1.2, 1.31, 2.0}) {
        const double volume = volume_inside_ball(1.1, 0.7, 0.4, rho);
        EXPECT_GT(volume, 0);
        EXPECT_EQ(volume_inside_ball(-1.1, 0.7, 0.4, rho), -volume);
        EXPECT_EQ(volume_inside_ball(1.1, -0.7, 0.4, rho), -volume);
        EXPECT_EQ(volume_inside_ball(1.1, 0.7, -0.4, rho), -volume);
        EXPECT_EQ(volume_inside_ball(-1.1, -0.7, -0.4, rho), -volume);
    }
}

TEST(BallOrthoscheme, VanishesWithAnyEdge) {
    EXPECT_EQ(volume_inside_ball(0, 1, 1, 0.5), 0);
    EXPECT_EQ(volume_inside_ball(1, 0, 1, 0.5), 0);
    EXPECT_EQ(volume_inside_ball(1, 1, 0, 0.5), 0);
    EXPECT_EQ(volume_inside_ball(1, 1, 1, 0), 0);
    for (const double rho : {0.5, 1.2, 1.5, 2.0}) {
        EXPECT_NEAR(volume_inside_ball(1, 1e-12, 1, rho), 0, 1e-12);
        EXPECT_NEAR(volume_inside_ball(1, 1, 1e-12, rho), 0, 1e-12);
        EXPECT_NEAR(volume_inside_ball(1e-12, 1, 1, rho), 0, 1e-12);
    }
}

TEST(BallOrthoscheme, FortyEightMakeABallInACube) {
    for (const double rho : {0.3, 0.9}) {
        EXPECT_NEAR(48 * volume_inside_ball(1, 1, 1, rho), 4 * std::numbers::pi / 3 * rho * rho * rho, 1e-13);
    }
    const double cap = std::numbers::pi / 3 * 0.3 * 0.3 * (3 * 1.3 - 0.3);
    EXPECT_NEAR(48 * volume_inside_ball(1, 1, 1, 1.3), 4 * std::numbers::pi / 3 * 1.3 * 1.3 * 1.3 - 6 * cap, 1e-13);
    EXPECT_NEAR(48 * volume_inside_ball(1, 1, 1, 2), 8, 1e-14);
}

}  // namespace
}  // namespace coagula::characterize
