// SPDX-License-Identifier: GPL-3.0-or-later
// Pair laws: force is the slope of the energy, and the closed forms of limiting cases; the DLVO potential of Schenker et al. 2012.
#include <coagula/generators/pair_potential.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"
#include "support/complaint.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::generators {
namespace {

using coagula::testing::complaint;
using examples::dlvo;
using examples::radius;
using examples::thermal;

const DoubleLayer layer{.surface_potential = 0.015, .debye_length = 10e-9, .relative_permittivity = 81, .temperature = 293};

/// -dE/dgap by central differences with Richardson extrapolation.
template <class Law>
double slope(const Law& law, double gap) {
    const auto difference = [&](double half) { return (law.energy(gap - half) - law.energy(gap + half)) / (2 * half); };
    const double half = 2e-3 * gap;
    return (4 * difference(half / 2) - difference(half)) / 3;
}

template <class Law>
void expect_force_is_slope(const Law& law, const std::string& name) {
    for (const double gap : {2e-9, 5e-9, 1.3e-8, 4e-8, 1.7e-7}) {
        EXPECT_NEAR(law.force(gap), slope(law, gap), 1e-6 * std::abs(law.force(gap)) + 1e-22) << name << " at " << gap;
    }
}

TEST(PairLaws, ForceIsTheSlopeOfTheEnergy) {
    for (const PairRadii pair : {PairRadii{radius, radius}, PairRadii{0.1e-6, 0.4e-6}}) {
        expect_force_is_slope(HamakerAttraction(4.76e-20, pair), "Hamaker");
        expect_force_is_slope(LinearSuperposition(layer, pair), "linear superposition");
        expect_force_is_slope(HoggHealyFuerstenau(layer, pair), "Hogg-Healy-Fuerstenau");
        expect_force_is_slope(Yukawa(-3e-20, 2e-8, pair), "Yukawa");
    }
    expect_force_is_slope(TabulatedLaw({1e-9, 4e-9, 9e-9, 2e-8, 5e-8, 3e-7}, {9e-20, 1e-20, 3e-20, -1e-20, 2e-21, 0}), "table");
    for (const double surface_potential : {0.0, 0.013, 0.05}) {
        expect_force_is_slope(dlvo(surface_potential), "sum with contact");
    }
}

TEST(PairLaws, HamakerHasItsLimits) {
    const HamakerAttraction equal(1, {1, 1});
    EXPECT_NEAR(equal.energy(1e-6) / (-1 / (12 * 1e-6)), 1, 1e-4);             // -A R/(12 h)
    EXPECT_NEAR(equal.energy(98) / (-16.0 / 9 * std::pow(100, -6)), 1, 1e-3);  // -16/9 A (R/r)^6
    const HamakerAttraction unequal(1, {1, 3});
    EXPECT_NEAR(unequal.energy(1e-6) / (-1.0 / (6e-6) * 3 / 4), 1, 1e-4);  // -A R1 R2/(6 h (R1 + R2))
    EXPECT_NEAR(unequal.energy(996) / (-16.0 / 9 * 27 * std::pow(1000, -6)), 1, 1e-3);
}

TEST(PairLaws, DoubleLayersAgreeWhereBothHold) {
    // Small potentials and several Debye lengths: both are 4 pi eps R/2 psi^2 exp(-kappa h).
    DoubleLayer weak = layer;
    weak.surface_potential = 1e-4;
    const double gap = 12 * weak.debye_length;
    const double expected = 4 * std::numbers::pi * vacuum_permittivity * 81 * radius / 2 * 1e-8 * std::exp(-12);
    EXPECT_NEAR(LinearSuperposition(weak, examples::radii).energy(gap) / expected, 1, 1e-5);
    EXPECT_NEAR(HoggHealyFuerstenau(weak, examples::radii).energy(gap) / expected, 1, 1e-5);
}

TEST(PairLaws, DebyeLengthOfWater) {
    // 0.304 nm/sqrt(I in mol/l) at 25 C (Israelachvili, Intermolecular and Surface Forces, eq. 14.36).
    EXPECT_NEAR(debye_length(1, 78.4, 298.15), 9.61e-9, 0.02e-9);
}

TEST(PairLaws, TableReproducesALaw) {
    const Yukawa law(5e-20, 1e-8, examples::radii);
    std::vector<double> gaps;
    std::vector<double> energies;
    for (int row = 0; row <= 400; ++row) {
        gaps.push_back(1e-9 + row * 5e-10);
        energies.push_back(law.energy(gaps.back()));
    }
    const TabulatedLaw table(gaps, energies);
    for (const double gap : {1.2e-8, 3.33e-8, 9.01e-8}) {
        EXPECT_NEAR(table.energy(gap), law.energy(gap) - energies.back(), 1e-6 * law.energy(gap));
        EXPECT_NEAR(table.force(gap), law.force(gap), 1e-4 * law.force(gap));
    }
    EXPECT_EQ(table.force(gaps.back()), 0);
    EXPECT_EQ(table.energy(1), 0);
}

TEST(PairPotential, HasThePublishedBarrier) {
    EXPECT_NEAR(dlvo(0.015).barrier_height(radius) / thermal, 5.65, 0.02);
    const auto minimum = dlvo(0.015).secondary_minimum(radius);
    ASSERT_TRUE(minimum);
    EXPECT_NEAR(minimum->energy / thermal, -1.8, 0.05);
    EXPECT_NEAR(minimum->gap, 40e-9, 1e-9);
}

TEST(PairPotential, HasNoBarrierBelowTwelveMillivolts) {
    for (const double surface_potential : {0.0, 0.005, 0.011, 0.0115}) {
        EXPECT_EQ(dlvo(surface_potential).barrier_height(radius), 0) << surface_potential;
        EXPECT_FALSE(dlvo(surface_potential).barrier(radius));
    }
    EXPECT_NEAR(dlvo(0.012).barrier_height(radius) / thermal, 0.08, 0.01);
}

TEST(PairPotential, RestsAtTheEquilibriumGap) {
    for (const double surface_potential : {0.0, 0.012, 0.015, 0.05}) {
        const PairPotential potential = dlvo(surface_potential);
        const double contact_force = potential.contact().stiffness * potential.cut_gap();
        EXPECT_NEAR(potential.force(0.004 * radius), 0, 1e-9 * contact_force);
        EXPECT_GT(potential.force(0.003 * radius), 0);
        EXPECT_LT(potential.force(0.005 * radius), 0);
        EXPECT_NEAR(potential.force(potential.cut_gap() * (1 - 1e-9)), potential.force(potential.cut_gap()), 1e-6 * contact_force);
    }
}

TEST(PairPotential, RefusesWhatIsImpossible) {
    DoubleLayer negative = layer;
    negative.debye_length = -1e-8;
    EXPECT_NE(complaint([&] { LinearSuperposition(negative, examples::radii); }).find("Debye length is -1e-08 m"),
              std::string::npos);
    EXPECT_NE(complaint([] { Yukawa(1e-20, 0, examples::radii); }).find("screening length is 0 m"), std::string::npos);
    EXPECT_NE(complaint([] {
                  PairPotential({Yukawa(1e-20, 1e-8, examples::radii)}, {0, 1e-9});
              }).find("without contact repulsion"),
              std::string::npos);
    EXPECT_NE(complaint([] {
                  PairPotential({HamakerAttraction(4.76e-20, examples::radii)}, {1e-8, 1e-9});
              }).find("too soft"),
              std::string::npos);
    EXPECT_NE(complaint([] { TabulatedLaw({1e-9, 3e-9, 2e-9, 4e-9}, {0, 0, 0, 0}); }).find("row 3"), std::string::npos);
    EXPECT_NE(complaint([] { PairPotential({}, {1, 1e-9}); }).find("no laws"), std::string::npos);
}

}  // namespace
}  // namespace coagula::generators
