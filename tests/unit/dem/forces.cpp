// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/forces.hpp>

#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

/// Moves and turns particles without dynamics: so heavy that no force matters.
template <class Laws>
void displace(ParticleSystem& system, const Laws& laws, const Eigen::Matrix3Xd& shift, const Eigen::Matrix3Xd& turn) {
    system.set_masses(Eigen::VectorXd::Constant(system.size(), 1e100));
    system.set_velocities(shift);
    system.set_spins(turn);
    step(system, laws, {.time_step = 1.0, .stop_after_step = true});
    compute_forces(system, laws);
}

/// Energy gradient by central differences of displacements (or turns) of each particle.
template <class Laws>
Eigen::Matrix3Xd gradient(const ParticleSystem& base, const Laws& laws, bool turns) {
    constexpr double h = 1e-5;
    Eigen::Matrix3Xd result(3, base.size());
    for (Index particle = 0; particle < base.size(); ++particle) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto energy_at = [&](double amount) {
                Eigen::Matrix3Xd change = Eigen::Matrix3Xd::Zero(3, base.size());
                const Eigen::Matrix3Xd none = change;
                change(axis, particle) = amount;
                ParticleSystem copy = base;
                displace(copy, laws, turns ? none : change, turns ? change : none);
                return potential_energy(copy, laws);
            };
            result(axis, particle) = (energy_at(h) - energy_at(-h)) / (2 * h);
        }
    }
    return result;
}

TEST(Forces, OfRepulsiveSpringsAreTheEnergyGradient) {
    const Packing packing = random_packing(Cell::periodic({5, 5, 5}), 20, 0.7, 1.1, 11);
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    compute_forces(system, central);
    ASSERT_GT(system.forces().norm(), 1);
    EXPECT_LT((system.forces() + gradient(system, central, false)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Forces, OfBondsAndUnbondedContactsAreTheEnergyGradient) {
    const Packing packing = cluster();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(cluster_bonds());
    displace(system, central, 0.2 * noise(6, 12), Eigen::Matrix3Xd::Zero(3, 6));
    ASSERT_GT(system.forces().norm(), 0.1);
    EXPECT_LT((system.forces() + gradient(system, central, false)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Forces, AndMomentsOfShearedBondsAreTheEnergyGradient) {
    const Packing packing = cluster();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(cluster_bonds());
    displace(system, sheared, 0.1 * noise(6, 13), 0.1 * noise(6, 14));
    ASSERT_GT(system.moments().norm(), 0.1);
    EXPECT_LT((system.forces() + gradient(system, sheared, false)).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((system.moments() + gradient(system, sheared, true)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Forces, OfASmallDisplacementAreThoseOfTheLinearContactLaw) {
    // delta = u_j - u_i - (R_i theta_i + R_j theta_j) x n with springs unstretched in the beginning.
    Packing packing{Cell::periodic({20, 20, 20}), Eigen::Matrix3Xd(3, 2), Eigen::Vector2d(1.0, 1.5)};
    packing.positions << 1, 2.5, 1, 3, 1, 1;  // 2.5 apart, direction (0.6, 0.8, 0)
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(find_contacts(packing, 0.01));
    const Eigen::Matrix3Xd shift = 1e-7 * noise(2, 15);
    const Eigen::Matrix3Xd turn = 1e-7 * noise(2, 16);
    displace(system, sheared, shift, turn);
    const Eigen::Vector3d n(0.6, 0.8, 0);
    const Eigen::Vector3d delta = shift.col(1) - shift.col(0) - (turn.col(0) + 1.5 * turn.col(1)).cross(n);
    const Eigen::Vector3d force = sheared.bond.force(delta, n);
    EXPECT_LT((system.forces().col(0) - force).norm(), 1e-13);
    EXPECT_LT((system.forces().col(1) + force).norm(), 1e-13);
    EXPECT_LT((system.moments().col(0) - n.cross(force)).norm(), 1e-13);
    EXPECT_LT((system.moments().col(1) - 1.5 * n.cross(force)).norm(), 1e-13);
}

/// Turns the cluster about an axis in `steps` steps; returns the system.
ParticleSystem turned_cluster(const Eigen::Vector3d& rotation, int steps, const Eigen::Matrix3Xd& first_shift) {
    const Packing packing = cluster();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
    system.add_bonds(cluster_bonds());
    displace(system, sheared, first_shift, Eigen::Matrix3Xd::Zero(3, 6));
    const Eigen::Vector3d spin = rotation / steps;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(spin.norm(), spin.normalized()).toRotationMatrix();
    for (int count = 0; count < steps; ++count) {
        const Eigen::Matrix3Xd positions = system.positions();
        displace(system, sheared, turn * positions - positions, spin.replicate(1, 6));
    }
    return system;
}

TEST(Forces, VanishWhenABondedClusterTurnsAsARigidBody) {
    const Packing packing = cluster();
    ParticleSystem still(packing.cell, packing.positions, packing.radii, 0.2);
    still.add_bonds(cluster_bonds());
    compute_forces(still, sheared);
    const Eigen::Vector3d rotation(0.5, -1.0, 0.8);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    const auto error = [&](int steps) {
        const ParticleSystem system = turned_cluster(rotation, steps, Eigen::Matrix3Xd::Zero(3, 6));
        return (system.forces() - turn * still.forces()).norm();
    };
    // Second order: what the finite steps leave behind falls fourfold with half the step.
    EXPECT_LT(error(100), 1e-3);
    EXPECT_LT(error(200), 0.26 * error(100) + 1e-12);
}

TEST(Forces, TurnWithAShearedClusterThatTurnsAsARigidBody) {
    const Eigen::Vector3d rotation(-1.1, 0.3, 0.9);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
    const Eigen::Matrix3Xd shift = 0.1 * noise(6, 17);
    const ParticleSystem before = turned_cluster(1e-9 * rotation, 1, shift);
    const ParticleSystem after = turned_cluster(rotation, 1000, shift);
    ASSERT_GT(before.moments().norm(), 0.1);
    EXPECT_LT((after.forces() - turn * before.forces()).norm(), 1e-5 * before.forces().norm());
    EXPECT_LT((after.moments() - turn * before.moments()).norm(), 1e-5 * before.moments().norm());
}

TEST(Forces, AndStepsAreEqualBitForBitForAnyNumberOfThreads) {
    const Packing packing = random_packing(Cell::periodic({22, 22, 22}), 4000, 0.6, 1.0, 18);
    const auto run = [&](int threads) {
        const int usual = omp_get_max_threads();
        omp_set_num_threads(threads);
        ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.2);
        EXPECT_GE(system.chunks().size(), static_cast<std::size_t>(detail::fewest_parallel_chunks));
        system.add_bonds(find_contacts(packing, -0.4));
        const Sheared laws{RepulsiveSpring(1.0), BondedContact(1.0, 0.1), true};
        for (int count = 0; count < 60; ++count) {
            step(system, laws, {.time_step = 0.2, .damping = 0.3});
        }
        omp_set_num_threads(usual);
        return std::tuple(system.positions(), system.spins(), system.forces(), system.bonds().size());
    };
    const auto one = run(1);
    ASSERT_GT(std::get<1>(one).norm(), 0);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(5));
}

}  // namespace
}  // namespace coagula::dem
