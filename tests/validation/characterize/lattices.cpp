// SPDX-License-Identifier: GPL-3.0-or-later
// Pore curves of crystals against closed forms and against integration over directions.
#include "unit/characterize/test_packings.hpp"

#include <coagula/characterize/pore_sizes.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace coagula::characterize {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double r0 = 0.25e-6;

/// One Wigner-Seitz cell: half spaces at distance `distance` from the centre with unit normals `normals`. Lengths in r0.
struct WignerSeitz {
    std::vector<Eigen::Vector3d> normals;
    std::vector<double> distance;
    double volume = 0;

    void add_family(const Eigen::Vector3d& vector) {  // all distinct signs and orders
        Eigen::Vector3d order = vector.cwiseAbs();
        std::sort(order.begin(), order.end());
        do {
            for (int signs = 0; signs < 8; ++signs) {
                Eigen::Vector3d normal = order;
                for (int axis = 0; axis < 3; ++axis) {
                    normal[axis] *= ((signs >> axis) & 1) != 0 ? -1 : 1;
                }
                const bool known = std::any_of(normals.begin(), normals.end(),
                                               [&](const auto& other) { return (other - normal.normalized()).norm() < 1e-12; });
                if (!known) {
                    normals.push_back(normal.normalized());
                    distance.push_back(normal.norm() / 2);
                }
            }
        } while (std::next_permutation(order.begin(), order.end()));
    }

    /// Volume of the ball of radius rho outside the planes, as long as the caps do not overlap.
    double covered_with_caps(double rho) const {
        double volume_covered = 4 * pi / 3 * rho * rho * rho;
        for (const double h : distance) {
            volume_covered -= rho > h ? pi / 3 * (rho - h) * (rho - h) * (2 * rho + h) : 0.0;
        }
        return volume_covered;
    }

    /// Volume of ball and cell by integrating min(rho, distance to the cell's surface)^3 / 3 over directions: (x, y) -> (x, y, 1)
    /// maps a face of the cube around the centre; the cubic symmetry leaves the triangle 0 < y < x < 1, a 48th of all directions.
    double covered_by_directions(double rho) const {
        constexpr int steps = 600;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j < steps; ++j) {
                const double x = (i + 0.5) / steps;
                const double y = x * (j + 0.5) / steps;
                const double norm = std::sqrt(1 + x * x + y * y);
                const Eigen::Vector3d direction(x / norm, y / norm, 1 / norm);
                double ray = rho;
                for (std::size_t k = 0; k < normals.size(); ++k) {
                    const double slope = normals[k].dot(direction);
                    ray = slope > 0 ? std::min(ray, distance[k] / slope) : ray;
                }
                sum += x * ray * ray * ray / (norm * norm * norm);
            }
        }
        return 48 * sum / 3 / (static_cast<double>(steps) * steps);
    }
};

struct Crystal {
    const char* name;
    Packing packing;
    WignerSeitz cell;
    double largest_pore;  ///< in r0
    double caps_meet;     ///< up to this ball radius the caps do not overlap, in r0
};

Crystal simple_cubic() {
    Crystal crystal{"sc", test::simple_cubic({3, 4, 5}, r0), {}, std::sqrt(3.0) - 1, std::sqrt(2.0)};
    crystal.cell.add_family({2, 0, 0});
    crystal.cell.volume = 8;
    return crystal;
}

Crystal face_centred() {
    Crystal crystal{"fcc", test::face_centred({3, 2, 4}, r0), {}, std::sqrt(2.0) - 1, 2 / std::sqrt(3.0)};
    crystal.cell.add_family({std::sqrt(2.0), std::sqrt(2.0), 0});
    crystal.cell.volume = 4 * std::sqrt(2.0);
    return crystal;
}

Crystal body_centred() {
    const double a = 4 / std::sqrt(3.0);
    // Largest pore at (1/2, 1/4, 0) a, at sqrt(5)/4 a from four centres. Triangles a, sqrt(3)/2 a, sqrt(3)/2 a have the
    // circumradius 3 a / sqrt(32).
    Crystal crystal{"bcc", test::body_centred({2, 3, 3}, r0), {}, std::sqrt(5.0 / 3) - 1, 3 * a / std::sqrt(32.0)};
    crystal.cell.add_family({a / 2, a / 2, a / 2});
    crystal.cell.add_family({a, 0, 0});
    crystal.cell.volume = a * a * a / 2;
    return crystal;
}

class Crystals : public ::testing::TestWithParam<Crystal (*)()> {};

TEST_P(Crystals, LargestPoreAndCellVolumes) {
    const Crystal crystal = GetParam()();
    const PoreSizes pores = measure_pores(crystal.packing);
    EXPECT_NEAR(pores.max / r0, crystal.largest_pore, 1e-10);
    EXPECT_LT(pores.cell_volume_defect, 1e-12);
    EXPECT_NEAR(pores.volume / crystal.packing.cell.volume(), 1, 1e-12);
    EXPECT_NEAR(pores.void_fraction, 1 - 4 * pi / 3 / crystal.cell.volume, 1e-12);
    EXPECT_EQ(pores.inner_particles, crystal.packing.size());
}

TEST_P(Crystals, CurveIsThatOfSphericalCaps) {
    const Crystal crystal = GetParam()();
    const PoreSizes pores = measure_pores(crystal.packing);
    int compared = 0;
    for (Index k = 0; k < pores.radius.size(); ++k) {
        const double rho = 1 + pores.radius[k] / r0;
        if (rho < crystal.caps_meet) {
            const double expected =
                (crystal.cell.volume - crystal.cell.covered_with_caps(rho)) / (crystal.cell.volume - 4 * pi / 3);
            EXPECT_NEAR(pores.exclusion_probability[k], expected, 1e-11) << crystal.name << " at " << rho;
            ++compared;
        }
    }
    EXPECT_GT(compared, 50);
}

TEST_P(Crystals, CurveIsThatOfIntegrationOverDirections) {
    const Crystal crystal = GetParam()();
    const PoreSizes pores = measure_pores(crystal.packing, {.radii = 24});
    for (Index k = 0; k < pores.radius.size(); ++k) {
        const double rho = 1 + pores.radius[k] / r0;
        const double expected =
            (crystal.cell.volume - crystal.cell.covered_by_directions(rho)) / (crystal.cell.volume - 4 * pi / 3);
        EXPECT_NEAR(pores.exclusion_probability[k], expected, 2e-5) << crystal.name << " at " << rho;
    }
}

TEST_P(Crystals, OneUnitCellIsEnough) {
    Crystal crystal = GetParam()();
    const PoreSizes many = measure_pores(crystal.packing);
    const double a = std::cbrt(crystal.cell.volume * (crystal.name == std::string("sc")    ? 1
                                                      : crystal.name == std::string("fcc") ? 4
                                                                                           : 2));
    const Packing unit = crystal.name == std::string("sc")    ? test::simple_cubic({1, 1, 1}, r0)
                         : crystal.name == std::string("fcc") ? test::face_centred({1, 1, 1}, r0)
                                                              : test::body_centred({1, 1, 1}, r0);
    EXPECT_NEAR(unit.cell.lengths()[0] / r0, a, 1e-12);
    const PoreSizes one = measure_pores(unit);
    EXPECT_LT((one.exclusion_probability - many.exclusion_probability).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT(one.cell_volume_defect, 1e-12);
}

TEST_P(Crystals, MomentsAreThoseOfAFinerCurve) {
    const Crystal crystal = GetParam()();
    const PoreSizes coarse = measure_pores(crystal.packing, {.radii = 4});
    const PoreSizes normal = measure_pores(crystal.packing);
    const PoreSizes fine = measure_pores(crystal.packing, {.radii = 4001});
    for (const PoreSizes* pores : {&coarse, &normal}) {
        EXPECT_NEAR(pores->mean / fine.mean, 1, 1e-6);
        EXPECT_NEAR(pores->second_moment / fine.second_moment, 1, 1e-6);
        EXPECT_NEAR(pores->median / fine.median, 1, 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Cubic, Crystals, ::testing::Values(&simple_cubic, &face_centred, &body_centred));

}  // namespace
}  // namespace coagula::characterize
