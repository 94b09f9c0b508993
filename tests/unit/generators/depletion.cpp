// SPDX-License-Identifier: GPL-3.0-or-later
// Depletion attraction: the closed forms of Asakura, Oosawa and Vrij, Morse's well in their place, and the bonds that it makes.
#include <coagula/generators/brownian_dynamics.hpp>
#include <coagula/generators/depletion.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"
#include "support/complaint.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace coagula::generators {
namespace {

using coagula::testing::complaint;
using examples::radius;
using examples::temperature;
using examples::thermal;

constexpr double rest_gap = 0.004 * radius;

PairPotential well(double depth, double size_ratio, std::optional<double> contact_stiffness = {}) {
    return depletion_potential(
        {.depth = depth * thermal, .range = 2 * size_ratio * radius, .rest_gap = rest_gap, .contact_stiffness = contact_stiffness});
}

/// Volume that two spheres of radius 1 + size_ratio share at a gap, both lengths in units of the radius: two caps.
double overlap_volume(double size_ratio, double gap) {
    const double depleted = 1 + size_ratio;
    const double cap = depleted - (2 + gap) / 2;
    return cap <= 0 ? 0 : 2 * std::numbers::pi * cap * cap * (depleted - cap / 3);
}

/// Energy of Asakura and Oosawa over kB T, of a depth at contact.
double asakura_oosawa(double depth, double size_ratio, double gap) {
    return -depth * overlap_volume(size_ratio, gap) / overlap_volume(size_ratio, 0);
}

/// What an attraction adds to the second virial coefficient of hard spheres, over theirs.
/// @param energy over kB T by the gap, in units of the radius.
template <class Energy>
double attraction_virial(double range, const Energy& energy) {
    constexpr int points = 40000;
    double sum = 0;
    for (int point = 0; point < points; ++point) {
        const double gap = range * (point + 0.5) / points;
        sum += (2 + gap) * (2 + gap) * (std::exp(-energy(gap)) - 1) * range / points;
    }
    return -3 * sum / 8;
}

TEST(Depletion, DepthIsOsmoticPressureTimesOverlap) {
    for (const double size_ratio : {0.05, 0.1, 0.25}) {
        const double coil = 4 * std::numbers::pi / 3 * std::pow(size_ratio, 3);
        EXPECT_NEAR(depletion_depth(0.7, size_ratio), 0.7 / coil * overlap_volume(size_ratio, 0), 1e-9) << size_ratio;
    }
}

TEST(Depletion, ForceIsTheSlopeOfTheEnergy) {
    const PairPotential potential = well(10, 0.1);
    for (const double gap : {-0.06, -0.03, -0.015, 0.0, 0.003, 0.02, 0.07, 0.2}) {
        const double half = 1e-4 * radius;
        const auto difference = [&](double step) {
            return (potential.energy(gap * radius - step) - potential.energy(gap * radius + step)) / (2 * step);
        };
        const double slope = (4 * difference(half / 2) - difference(half)) / 3;
        EXPECT_NEAR(potential.force(gap * radius), slope, 1e-6 * thermal / radius * 300) << gap;
    }
}

TEST(Depletion, TheWellHasItsDepthAndItsSlopeGoesOnBelow) {
    for (const double depth : {2.0, 10.0, 40.0}) {
        const PairPotential potential = well(depth, 0.1);
        EXPECT_TRUE(potential.has_well());
        EXPECT_NEAR(potential.contact_minimum().gap / rest_gap, 1, 1e-9);
        EXPECT_NEAR(potential.contact_minimum().energy / thermal, -depth, 1e-9 * depth);
        EXPECT_NEAR(potential.energy(potential.cut_gap()) / thermal, 0, 1e-9 * depth);
        EXPECT_NEAR(potential.energy(rest_gap + 0.2 * radius) / (depth * thermal), -0.005, 1e-4);
        EXPECT_FALSE(potential.barrier(radius));
        EXPECT_EQ(potential.barrier_height(radius), 0);
        const double step = 1e-6 * radius;
        const double above = (potential.force(potential.cut_gap()) - potential.force(potential.cut_gap() + step)) / step;
        EXPECT_NEAR(above / potential.contact().stiffness, 1, 1e-3);
    }
}

TEST(Depletion, AContactOfGivenStiffnessTakesOverAtItsSlope) {
    const double curvature = 2 * 10 * thermal / std::pow(0.2 * radius / 6, 2);
    const PairPotential potential = well(10, 0.1, 3 * curvature);
    EXPECT_EQ(potential.contact().stiffness, 3 * curvature);
    EXPECT_NEAR(potential.cut_gap() - rest_gap, -0.2 * radius / 6 * std::log(1.5), 1e-6 * radius);  // 2 x^2 - x = 3
    EXPECT_NE(complaint([&] { well(10, 0.1, 0.9 * curvature); }).find("softer than the attraction's well"), std::string::npos);
}

TEST(Depletion, BondsHaveTheStiffnessOfTheWell) {
    const double curvature = 2 * 10 * thermal / std::pow(0.2 * radius / 6, 2);
    const BoundPair bond = bound_pair(well(10, 0.1), radius, temperature, rest_gap + 0.2 * radius);
    EXPECT_NEAR(bond.stiffness / curvature, 1, 1e-6);
    EXPECT_NEAR(bond.rupture_force / (0.5 * 10 * thermal / (0.2 * radius / 6)), 1, 1e-6);
    // Thermal motion in a well that is softer outside than inside; in a deep one it is the curvature but for a first correction.
    EXPECT_LT(bond.thermal_stiffness, bond.stiffness);
    const BoundPair deep = bound_pair(well(4000, 0.1), radius, temperature, rest_gap + 0.2 * radius);
    EXPECT_NEAR(deep.thermal_stiffness / deep.stiffness, 1, 2e-3);
    EXPECT_NE(complaint([] { bound_pair(examples::dlvo(0), radius, temperature, radius); }).find("none of their own"),
              std::string::npos);
}

TEST(Depletion, AttractsAsAsakuraAndOosawaByItsSecondVirialCoefficient) {
    // Of the same depth. The wall of hard spheres is in the same place, so that only the wells are compared: Morse's beyond its
    // bottom against theirs beyond contact.
    for (const double size_ratio : {0.05, 0.1, 0.15}) {
        for (const double depth : {5.0, 10.0, 20.0}) {
            const PairPotential potential = well(depth, size_ratio);
            const double length = 2 * size_ratio / 6;
            const double morse = attraction_virial(2 * size_ratio, [&](double gap) {
                const double x = std::exp(-gap / length);
                EXPECT_NEAR(potential.energy(rest_gap + gap * radius) / thermal, depth * x * (x - 2), 1e-9 * depth);
                return depth * x * (x - 2);
            });
            const double theirs =
                attraction_virial(2 * size_ratio, [&](double gap) { return asakura_oosawa(depth, size_ratio, gap); });
            std::printf("size ratio %.2f, %2.0f kT: %.3f of their attraction\n", size_ratio, depth, morse / theirs);
            EXPECT_GT(morse / theirs, 0.8);
            EXPECT_LT(morse / theirs, 1.5);
        }
    }
}

TEST(Depletion, TheTimeStepIsStableAndSmallBesideTheWell) {
    for (const double size_ratio : {0.02, 0.05, 0.1, 0.2}) {
        const PairPotential potential = well(10, size_ratio);
        const TimeStep step = choose_time_step(potential, radius, radius, {});
        const double tau = step.diffusion_time;
        const double length = 2 * size_ratio / 6;
        const double steepest = 10 / (4 * length * length);  // of the falling attraction, kB T/R^2
        EXPECT_LE(step.time_step, 0.5 * step.stability_bound);
        EXPECT_LE(step.time_step / tau, 1.02 / (28 * steepest));
        if (size_ratio < 0.1) {
            EXPECT_EQ(step.reason, "the width of the attraction");
        }
        BrownianOptions longer;
        longer.time_step = 1.01 * step.stability_bound;
        EXPECT_NE(complaint([&] { choose_time_step(potential, radius, radius, longer); }).find("stable up to"), std::string::npos);
        BrownianOptions sticky;
        sticky.resistance.tangential_stiffness = 1e-3;
        EXPECT_NE(complaint([&] { choose_time_step(potential, radius, radius, sticky); }).find("well of its own"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace coagula::generators
