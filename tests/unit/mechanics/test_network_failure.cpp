// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static shear of networks that snap, become floppy or part.
#include <coagula/mechanics/quasistatic.hpp>

#include "quasistatic_examples.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::mechanics {
namespace {

using quasistatic_examples::Columns;
using quasistatic_examples::gel;
using quasistatic_examples::radius;
using quasistatic_examples::springs;
using quasistatic_examples::stress_zx;
using quasistatic_examples::zx;

/// A chain along the plates may hold: it takes no part.
TEST(NetworkFailure, SweepEndsWhereNothingReachesFromPlateToPlate) {
    const double length = 2 * radius;
    Columns chains({20 * radius, 20 * radius, length}, {radius, radius});
    chains.join(0, {0, 0, length});
    chains.join(1, {20 * radius, 0, 0});
    ContactModel model = springs();
    model.normal_strength = 0.02 * 50 * length;
    const double breaks_at = std::sqrt(1.02 * 1.02 - 1);
    const auto sweep =
        sweep_amplitudes(chains.packing, chains.bonds, model, {.amplitudes = {0.05, 0.1, 0.3, 0.1}, .solver = {.orientation = zx}});
    ASSERT_EQ(sweep.amplitudes.size(), 2U);
    EXPECT_GT(sweep.amplitudes[1].storage_modulus, 0);
    ASSERT_TRUE(sweep.failure);
    EXPECT_NEAR(sweep.failure->strain, breaks_at, 1e-8);
    EXPECT_TRUE(sweep.failure->parted);
    EXPECT_EQ(sweep.broken.size(), 1U);
    EXPECT_THROW(small_strain_moduli(chains.packing, chains.bonds, model, 0.3), std::runtime_error);
}

/// Parts without moments that are pressed snap over, further than the forces of one descent can tell: it has to begin anew from
/// where it came to.
TEST(NetworkFailure, SnappingPartsAreFollowed) {
    const auto sample = gel(200);
    const auto ramp = shear_to(sample.packing, sample.contacts, springs(),
                               {.strain = 1e-3, .steps = 2, .solver = {.orientation = zx, .smallest_step = 0.1}});
    EXPECT_GT(ramp.effort.jumps, 0);
    EXPECT_LT(std::abs(ramp.points.back().imbalance(ramp.points.front())), 1e-5 * ramp.points.back().work);
}

/// What is left of it snaps on and on, through contacts that open and close by less than a billionth of a radius.
TEST(NetworkFailure, RampGoesOnPastTheLossOfLoad) {
    const auto sample = gel(120);
    ContactModel model = springs();
    model.normal_strength = 1e-10;
    const auto ramp =
        shear_to(sample.packing, sample.contacts, model, {.strain = 2.54e-3, .steps = 10, .solver = {.orientation = zx}});
    ASSERT_TRUE(ramp.failure);
    EXPECT_FALSE(ramp.failure->parted);
    EXPECT_GT(ramp.failure->broken, 10);
    EXPECT_LT(ramp.failure->strain, 2.53e-3);
    EXPECT_NEAR(ramp.points.back().strain, 2.54e-3, 1e-12);
}

/// Springs without moments: in the end all is floppy, though chains still reach around the cell.
TEST(NetworkFailure, FloppyNetworkIsFollowedUntilItBearsNothing) {
    const auto sample = gel(100);
    ContactModel model = springs();
    model.normal_strength = 1e-10;
    const auto ramp =
        shear_to(sample.packing, sample.contacts, model, {.strain = 2e-3, .steps = 10, .solver = {.orientation = zx}});
    EXPECT_GT(ramp.broken.size(), 10U);
    EXPECT_EQ(ramp.points.back().bonds, sample.contacts.size() - static_cast<Index>(ramp.broken.size()));
    const double imbalance = ramp.points.back().imbalance(ramp.points.front());
    EXPECT_LT(std::abs(imbalance), 1e-5 * ramp.points.back().work);
    ASSERT_TRUE(ramp.failure);
    EXPECT_FALSE(ramp.failure->parted);
    EXPECT_EQ(ramp.failure->broken, static_cast<Index>(ramp.broken.size()));
    double peak = 0;
    for (const StrainPoint& point : ramp.points) {
        peak = std::max(peak, std::abs(stress_zx(point)));
    }
    for (const StrainPoint& point : ramp.points) {
        EXPECT_TRUE(point.strain <= ramp.failure->strain || std::abs(stress_zx(point)) < 1e-3 * peak) << point.strain;
    }
}

}  // namespace
}  // namespace coagula::mechanics
