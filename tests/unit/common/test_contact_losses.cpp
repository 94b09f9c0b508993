// SPDX-License-Identifier: GPL-3.0-or-later
// Friction, losses, strengths and ageing of the general contact law against closed forms.
#include "contact_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coagula {
namespace {

using coagula::testing::ContactPair;
using Eigen::Vector3d;
using std::numbers::pi;

TEST(ContactFriction, ShearForceEndsAtTheLimit) {
    ContactPair pair{GeneralContact({.friction = 0.3})};
    const double overlap = 2e-9;
    pair.touch(overlap);
    const double limit = 0.3 * 50 * overlap;
    for (int step = 0; step < 50; ++step) {
        const Vector3d force = pair.slide(0.5e-9).force;
        const Vector3d shear = force - force.dot(ContactPair::normal()) * ContactPair::normal();
        const double sliding = 0.5e-9 * (step + 1);
        EXPECT_NEAR(shear.norm(), std::min(5 * sliding, limit), 1e-9 * limit);
    }
    EXPECT_EQ(pair.load_ratio(), 0);
}

/// Steady cycle of amplitude A > mu F / k_s: the loop encloses 4 mu F (A - mu F / k_s).
TEST(ContactFriction, StickSlipCycleLosesTheAreaOfItsLoop) {
    ContactPair pair{GeneralContact({.friction = 0.3})};
    const double overlap = 2e-9;
    pair.touch(overlap);
    const double limit = 0.3 * 50 * overlap;
    const double amplitude = 20e-9;
    const int quarter = 1000;
    const double step = amplitude / quarter;
    double work = 0;
    const auto sweep = [&](int steps, double direction) {
        for (int count = 0; count < steps; ++count) {
            const Vector3d before = 5 * pair.memory.shear;
            const Vector3d after = pair.slide(direction * step).force;
            work += 0.5 * direction * step * (before + after).dot(ContactPair::across());
        }
    };
    sweep(quarter, 1);
    pair.dissipated = 0;
    work = 0;
    const double stored = pair.energy();
    sweep(2 * quarter, -1);
    sweep(2 * quarter, 1);
    const double loop = 4 * limit * (amplitude - limit / 5);
    EXPECT_NEAR(pair.dissipated, loop, 1e-3 * loop);
    EXPECT_NEAR(work, pair.dissipated, 1e-9 * loop);
    EXPECT_NEAR(pair.energy(), stored, 1e-9 * stored);
}

TEST(ContactFriction, WithoutAnyContactsSlipFreely) {
    ContactPair pair{GeneralContact({})};
    pair.touch(2e-9);
    const Vector3d force = pair.slide(1e-9).force;
    EXPECT_LT((force + 50 * 2e-9 * ContactPair::normal()).norm(), 1e-20);
    EXPECT_TRUE(pair.law.touches(pair.memory, pair.first_radius, pair.second_radius));
    EXPECT_EQ(pair.stretch(3e-9).force, Vector3d::Zero());
    EXPECT_FALSE(pair.law.touches(pair.memory, pair.first_radius, pair.second_radius));
}

/// Elata and Berryman 1996: a sheared contact that is pressed harder keeps its force, one that is unloaded its displacement.
TEST(ContactMicroSlip, ChangeOfStiffnessLosesEnergyInClosedForm) {
    ContactPair pair{GeneralContact({.young_modulus = 70e9, .poisson_ratio = 0.25, .friction = 10})};
    pair.touch(1e-9);
    pair.slide(0.1e-9);
    EXPECT_EQ(pair.dissipated, 0);
    const double soft = pair.memory.shear_stiffness;
    const double energy = 0.5 * soft * 0.01e-18;
    pair.stretch(-3e-9);  // contact radius and stiffness double
    EXPECT_NEAR(pair.memory.shear_stiffness, 2 * soft, 1e-9 * soft);
    EXPECT_NEAR(pair.memory.shear.norm(), 0.05e-9, 1e-18);
    EXPECT_NEAR(pair.dissipated, 0.5 * energy, 1e-8 * energy);
    pair.stretch(3e-9);
    EXPECT_NEAR(pair.memory.shear.norm(), 0.05e-9, 1e-18);
    EXPECT_NEAR(pair.dissipated, 0.75 * energy, 1e-8 * energy);
}

TEST(ContactMicroSlip, WorkIsStoredOrDissipatedAlongAnyPath) {
    ContactPair pair{GeneralContact({.young_modulus = 70e9, .poisson_ratio = 0.25, .friction = 0.4})};
    pair.touch(2e-9);
    double work = 0;
    double least = 0;
    for (int step = 0; step < 4000; ++step) {
        const double phase = 2 * pi * step / 1000;
        const double overlap = 2e-9 * (1 + 0.5 * std::sin(phase));
        const double next_overlap = 2e-9 * (1 + 0.5 * std::sin(phase + 2 * pi / 1000));
        pair.stretch(overlap - next_overlap);
        const double lost_before = pair.dissipated;
        const double energy_before = pair.energy();
        const Vector3d before = pair.memory.shear_stiffness * pair.memory.shear;
        const double slide = 2e-9 * (std::sin(2 * phase + 4 * pi / 1000) - std::sin(2 * phase));
        const Vector3d after = pair.slide(slide).force;
        const double taken = 0.5 * slide * (before + after).dot(ContactPair::across());
        const double lost = pair.dissipated - lost_before;
        EXPECT_NEAR(taken, pair.energy() - energy_before + lost, 1e-9 * std::abs(taken) + 1e-27) << step;
        work += std::abs(taken);
        least = std::min(least, lost);
    }
    EXPECT_GT(pair.dissipated, 0.1 * work);
    EXPECT_GT(least, -1e-6 * pair.dissipated);
}

/// Energy lost in a cycle of amplitude A is pi k'' A^2, k'' the imaginary part of the complex stiffness.
void expect_loss_of_complex_stiffness(const ContactModel& model, bool normal) {
    ContactPair pair{GeneralContact(model)};
    pair.bond(0.45e-6);
    const double w = 40;
    const double amplitude = 1e-10;
    const int steps = 2000;  // per cycle
    double stored = 0;
    for (int step = 0; step < 12 * steps; ++step) {
        const double now = std::sin(2 * pi * step / steps);
        const double next = std::sin(2 * pi * (step + 1) / steps);
        const double duration = 2 * pi / w / steps;
        if (step == 11 * steps) {
            pair.dissipated = 0;
            stored = pair.energy();
        }
        normal ? pair.stretch(amplitude * (next - now), duration) : pair.slide(amplitude * (next - now), duration);
    }
    const ContactStiffness k = complex_stiffness(model, w);
    const double loss = pi * amplitude * amplitude * (normal ? k.normal : k.shear).imag();
    EXPECT_NEAR(pair.dissipated, loss, 1e-3 * loss);
    EXPECT_NEAR(pair.energy(), stored, 1e-3 * loss);
}

TEST(ContactLosses, HarmonicCyclesLoseWhatTheComplexStiffnessSays) {
    ContactModel dashpots;
    dashpots.normal_viscosity = 0.3;
    dashpots.shear_viscosity = 0.04;
    ContactModel maxwell;
    maxwell.normal_maxwell_stiffness = 20;
    maxwell.normal_maxwell_time = 0.01;
    maxwell.shear_maxwell_stiffness = 4;
    maxwell.shear_maxwell_time = 0.05;
    for (const ContactModel& model : {dashpots, maxwell}) {
        expect_loss_of_complex_stiffness(model, true);
        expect_loss_of_complex_stiffness(model, false);
    }
}

TEST(ContactLosses, MaxwellSpringRelaxesExponentially) {
    ContactModel model;
    model.shear_maxwell_stiffness = 4;
    model.shear_maxwell_time = 0.05;
    ContactPair pair{GeneralContact(model)};
    pair.bond(0.45e-6);
    const double start = pair.slide(1e-10, 1e-9).force.norm();
    EXPECT_NEAR(start, 9e-10, 1e-16);
    double force = 0;
    for (int step = 0; step < 10; ++step) {
        force = pair.slide(0, 0.01).force.norm();
    }
    EXPECT_NEAR(force, 5e-10 + 4e-10 * std::exp(-2), 1e-16);
    EXPECT_NEAR(pair.dissipated, 0.5 * 4 * 1e-20 * (1 - std::exp(-4)), 1e-25);
    pair.slide(0, 0);  // infinitely slow
    EXPECT_EQ(pair.memory.maxwell, Vector3d::Zero());
}

ContactModel breakable() {
    return {.bending_stiffness = 3e-13,
            .twisting_stiffness = 2e-13,
            .normal_strength = 1e-7,
            .shear_strength = 2e-8,
            .bending_strength = 1e-15};
}

TEST(ContactStrength, RatioIsOneAtTheLoadThatBreaks) {
    ContactPair pair{GeneralContact(breakable())};
    pair.bond(0.45e-6);
    EXPECT_EQ(pair.load_ratio(), 0);
    ContactPair pulled = pair;
    pulled.stretch(1e-7 / 50);
    EXPECT_NEAR(pulled.load_ratio(), 1, 1e-7);
    EXPECT_EQ(pulled.load().limit, BreakageCause::normal);
    ContactPair pressed = pair;
    pressed.stretch(-1e-7 / 50);
    EXPECT_NEAR(pressed.load_ratio(), 0, 1e-12);
    ContactPair sheared = pair;
    sheared.slide(2e-8 / 5);
    EXPECT_NEAR(sheared.load_ratio(), 1, 1e-9);
    EXPECT_EQ(sheared.load().limit, BreakageCause::shear);
    ContactPair bent = pair;
    // Opposite turns in the ratio of the levers: the contact point does not move.
    const double angle = 1e-15 / 3e-13;
    const double share = pair.first_radius / pair.touching_distance();
    bent.move(pair.memory.branch, -(1 - share) * angle * ContactPair::across(), share * angle * ContactPair::across());
    EXPECT_NEAR(bent.load_ratio(), 1, 1e-9);
    EXPECT_EQ(bent.load().limit, BreakageCause::bending);
    EXPECT_LT(bent.memory.shear.norm(), 1e-9 * 0.45e-6);
    ContactPair twisted = pair;
    twisted.move(pair.memory.branch, Vector3d::Zero(), 1e-15 / 2e-13 * ContactPair::normal());
    EXPECT_NEAR(twisted.load_ratio(), 1, 1e-9);
    EXPECT_EQ(twisted.load().limit, BreakageCause::bending);
}

/// The nearest limit decides, at every age: twice as stiff springs bear twice the force at the same stretch.
TEST(ContactStrength, NearestLimitIsTheCause) {
    ContactPair pair{GeneralContact(breakable())};
    pair.law.set_age_factor(2);
    pair.bond(0.45e-6);
    pair.stretch(0.6e-7 / 50);
    pair.slide(0.4e-8 / 5);
    EXPECT_NEAR(pair.load_ratio(), 1.2, 1e-6);
    EXPECT_EQ(pair.load().limit, BreakageCause::normal);
    pair.slide(1e-8 / 5);
    EXPECT_NEAR(pair.load_ratio(), 1.4, 1e-6);
    EXPECT_EQ(pair.load().limit, BreakageCause::shear);
}

TEST(ContactStrength, AdhesiveBondEndsWhereItsLawDoes) {
    ContactPair pair{GeneralContact({.young_modulus = 70e9, .poisson_ratio = 0.25, .work_of_adhesion = 0.5})};
    pair.bond(0.45e-6);
    const double modulus = 70e9 / (2 * (1 - 0.0625));
    const double radius = pair.effective_radius();
    const double end = std::cbrt(pi * 0.5 * radius * radius / (8 * modulus));
    const double rest = std::cbrt(4.5 * pi * 0.5 * radius * radius / modulus);
    const double reach = 3 * end * end / radius + rest * rest / (3 * radius);
    pair.stretch(reach);
    EXPECT_NEAR(pair.load_ratio(), 1, 1e-9);
    EXPECT_EQ(pair.load().limit, BreakageCause::pull_off);
    EXPECT_NEAR(pair.memory.shear_stiffness / (8 * 70e9 / (4 * 1.25 * 1.75)), end, 1e-4 * end);
}

TEST(ContactStrength, BreakingLosesWhatCannotBeKept) {
    ContactModel model = breakable();
    model.friction = 0.2;
    ContactPair pair{GeneralContact(model)};
    pair.bond(0.45e-6);
    ContactPair pulled = pair;
    pulled.stretch(1e-9);
    pulled.slide(2e-9);
    const double all = 25e-18 + 10e-18;
    EXPECT_NEAR(pulled.law.break_bond(pulled.memory, pulled.first_radius, pulled.second_radius), all, 1e-7 * all);
    EXPECT_EQ(pulled.energy(), 0);
    EXPECT_FALSE(pulled.law.touches(pulled.memory, pulled.first_radius, pulled.second_radius));

    ContactPair pressed = pair;
    pressed.stretch(-1e-9);
    pressed.slide(4e-9);  // 2e-8 N, of which friction holds 1e-8 N
    pressed.move(pressed.memory.branch, Vector3d::Zero(), 1e-3 * ContactPair::normal());
    const double lost = 0.5 * (4e-16 - 1e-16) / 5 + 0.5 * 2e-13 * 1e-6;
    EXPECT_NEAR(pressed.law.break_bond(pressed.memory, pressed.first_radius, pressed.second_radius), lost, 1e-7 * lost);
    const ContactForce after = pressed.stay();
    EXPECT_NEAR(after.force.dot(ContactPair::normal()), -5e-8, 1e-14);
    EXPECT_NEAR(after.force.dot(ContactPair::across()), 1e-8, 1e-14);
    EXPECT_EQ(after.moment, Vector3d::Zero());
    EXPECT_EQ(after.dissipated, 0);
}

TEST(ContactAgeing, ForcesStayWhileNewSpringsGrowUnstressed) {
    for (const bool bonded : {true, false}) {
        for (const bool hertzian : {false, true}) {
            ContactModel model{.bending_stiffness = 3e-13, .twisting_stiffness = 2e-13, .friction = 0.5};
            if (hertzian) {
                model.young_modulus = 70e9;
                model.poisson_ratio = 0.25;
                model.work_of_adhesion = 0.5;
            }
            ContactPair pair{GeneralContact(model)};
            bonded ? pair.bond(0.45e-6) : pair.touch(0);
            pair.stretch(-1e-9);
            pair.slide(1e-10);
            pair.move(pair.memory.branch, Vector3d::Zero(), 1e-5 * Vector3d(1, 2, 3));
            const ContactForce before = pair.stay();
            const double energy = pair.energy();
            pair.law.set_age_factor(1.6);
            const double lost = pair.law.reage(pair.memory, 1.0, pair.first_radius, pair.second_radius);
            const ContactForce after = pair.stay();
            EXPECT_LT((after.force - before.force).norm(), 1e-9 * before.force.norm()) << bonded << hertzian;
            EXPECT_LE((after.moment - before.moment).norm(), 1e-12 * before.moment.norm()) << bonded << hertzian;
            EXPECT_NEAR(energy - pair.energy(), lost, 1e-12 * energy);
            EXPECT_GT(lost, 0);
            if (!hertzian) {
                EXPECT_NEAR(lost, energy * (1 - 1 / 1.6), 1e-9 * energy);
            }
        }
    }
}

}  // namespace
}  // namespace coagula
