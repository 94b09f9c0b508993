// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

/// Two bonded unit spheres along x, `stretch` apart, in a wide box.
ParticleSystem pair_of_spheres(double stretch) {
    Packing packing{Cell::periodic({20, 20, 20}), Eigen::Matrix3Xd(3, 2), Eigen::Vector2d(1, 1)};
    packing.positions << 5, 7 + stretch, 5, 5, 5, 5;
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.1);
    system.add_bonds(find_pairs(packing, 4));
    return system;
}

ParticleSystem moving_cluster() {
    const Packing packing = cluster();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.set_masses(Eigen::VectorXd::LinSpaced(6, 1.0, 2.0));
    system.add_bonds(cluster_bonds());
    system.set_velocities(0.1 * noise(6, 21));
    system.set_spins(0.1 * noise(6, 22));
    return system;
}

TEST(Stepper, LetsAFreeParticleFlyThroughThePeriodicBox) {
    ParticleSystem system(Cell::periodic({4, 5, 6}), Eigen::Vector3d(1, 1, 1), Eigen::VectorXd::Constant(1, 0.5), 0.3);
    system.set_velocities(Eigen::Vector3d(0.25, -0.5, 1));
    for (int count = 0; count < 64; ++count) {
        step(system, central, {.time_step = 0.125, .damping = 0.7});  // no force, so nothing to damp
    }
    EXPECT_LT((system.positions() - Eigen::Vector3d(3, 2, 3)).norm(), 1e-12);
    EXPECT_GT(system.list_builds(), 5);
}

TEST(Stepper, FollowsTheClosedFormOfAnOscillator) {
    // Reduced mass m/2: omega^2 = 2 k / m. Central differences give x_n = A cos(n w dt) with sin(w dt / 2) = omega dt / 2 exactly.
    const double amplitude = 0.1, dt = 0.05, omega = std::sqrt(2 * 3.0 / 1.5);
    const double phase = 2 * std::asin(omega * dt / 2);
    ParticleSystem system = pair_of_spheres(amplitude);
    system.set_masses(Eigen::Vector2d(1.5, 1.5));
    Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, 2);
    velocities(0, 1) = amplitude * (1 - std::cos(phase)) / dt / 2;  // at t = -dt/2
    velocities(0, 0) = -velocities(0, 1);
    system.set_velocities(velocities);
    for (int count = 1; count <= 500; ++count) {
        step(system, central, {.time_step = dt});
        const double stretch = system.positions()(0, 1) - system.positions()(0, 0) - 2;
        ASSERT_NEAR(stretch, amplitude * std::cos(count * phase), 1e-12);
    }
}

/// Largest departure of the energy from its first value, over time 20. Velocities stand half a step off: their energies before and
/// after a position are averaged.
double energy_error(double dt) {
    ParticleSystem system = moving_cluster();
    double first = 0, worst = 0, before = kinetic_energy(system);
    const int steps = static_cast<int>(std::lround(20 / dt));
    for (int count = 0; count < steps; ++count) {
        ParticleSystem now = system;
        compute_forces(now, sheared);
        const double potential = potential_energy(now, sheared);
        step(system, sheared, {.time_step = dt});
        const double after = kinetic_energy(system);
        const double energy = potential + 0.5 * (before + after);
        first = count == 0 ? energy : first;
        worst = std::max(worst, std::abs(energy - first) / first);
        before = after;
    }
    return worst;
}

TEST(Stepper, ConservesEnergyToSecondOrderWithoutDamping) {
    const double coarse = energy_error(0.04);
    const double fine = energy_error(0.02);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_LT(fine, 0.3 * coarse);
}

TEST(Stepper, ConservesMomentumAndAngularMomentum) {
    ParticleSystem system = moving_cluster();
    const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(6, 1.0, 2.0);
    const Eigen::VectorXd inertias = 0.4 * masses.array() * system.radii().array().square();
    // Angular momentum with x at the middle of the step, where v is known; conserved exactly by central differences.
    const auto measure = [&] {
        const double dt = 0.05;
        const Eigen::Matrix3Xd v = system.velocities();
        const Eigen::Matrix3Xd x = system.positions() - 0.5 * dt * v;
        Eigen::Matrix<double, 6, 1> result = Eigen::Matrix<double, 6, 1>::Zero();
        for (Index i = 0; i < 6; ++i) {
            result.head<3>() += masses[i] * v.col(i);
            result.tail<3>() += masses[i] * Eigen::Vector3d(x.col(i)).cross(Eigen::Vector3d(v.col(i)));
            result.tail<3>() += inertias[i] * system.spins().col(i);
        }
        return result;
    };
    step(system, sheared, {.time_step = 0.05});
    const auto start = measure();
    for (int count = 0; count < 1000; ++count) {
        step(system, sheared, {.time_step = 0.05});
    }
    EXPECT_LT((measure() - start).norm(), 1e-11);
}

TEST(Stepper, DampingBrakesWhatAcceleratesAndNothingElse) {
    // Eq. 3 of Schenker et al. 2012, per component: the force is 0.3 on sphere 0 and -0.3 on sphere 1, along x.
    const double force = 0.3, dt = 0.01, alpha = 0.9;
    for (const double speed : {-0.2, 0.0, 0.2}) {
        ParticleSystem system = pair_of_spheres(0.1);
        Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, 2);
        velocities.col(0) << speed, 0.5, 0;
        system.set_velocities(velocities);
        step(system, central, {.time_step = dt, .damping = alpha});
        const double sign = speed > 0 ? 1 : (speed < 0 ? -1 : 0);
        EXPECT_NEAR(system.velocities()(0, 0), speed + dt * (force - alpha * force * sign), 1e-13);
        EXPECT_EQ(system.velocities()(1, 0), 0.5);  // no force, no damping
        EXPECT_NEAR(system.velocities()(0, 1), -dt * force, 1e-13);
    }
}

TEST(Stepper, DampingTakesEnergyFromTranslationAndRotation) {
    ParticleSystem system = moving_cluster();
    Eigen::Matrix3Xd velocities = system.velocities();
    for (int count = 0; count < 4000; ++count) {
        step(system, sheared, {.time_step = 0.05, .damping = 0.3});
    }
    // What is left is drift and spin of the whole, which no contact feels.
    compute_forces(system, sheared);
    EXPECT_LT(rms_force(system), 1e-3);
}

TEST(Stepper, StopsAllMotionAfterEachStepIfAsked) {
    ParticleSystem system = moving_cluster();
    const Eigen::Matrix3Xd start = system.positions();
    step(system, sheared, {.time_step = 0.05, .stop_after_step = true});
    EXPECT_GT((system.positions() - start).norm(), 0);
    EXPECT_EQ(kinetic_energy(system), 0);
    // The turn of that step is not lost with the spin.
    compute_forces(system, sheared);
    EXPECT_GT(system.moments().norm(), 1e-4);
}

TEST(Stepper, RejectsImpossibleOptions) {
    EXPECT_THROW(check(StepOptions{}), std::invalid_argument);
    EXPECT_THROW(check(StepOptions{.time_step = -1}), std::invalid_argument);
    EXPECT_THROW(check(StepOptions{.time_step = 1, .damping = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::dem
