// SPDX-License-Identifier: GPL-3.0-or-later
// Shear of the cell and the general contact law in the explicit stepper.
#include "example_systems.hpp"

#include <coagula/common/dem/general_forces.hpp>
#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::dem {
namespace {

constexpr double skin = 0.3;

Packing loose_packing() {
    return random_packing(Cell::periodic({9, 8, 7}), 60, 0.6, 0.9, 5);
}

/// Springs of one contact: 1 and 0.2 N/m.
ContactModel unit_model() {
    return {.normal_stiffness = 2, .shear_stiffness = 0.4};
}

ParticleSystem bonded_system(const Packing& packing, const GeneralContact& law) {
    ParticleSystem system(packing.cell, packing.positions, packing.radii, skin);
    system.use_general_contacts(true);
    system.add_bonds(find_contacts(packing, 0.05), [&](const Eigen::Vector3d& branch, double first, double second) {
        return law.make_bond(branch, first, second, branch.norm());
    });
    return system;
}

const Interactions<RepulsiveSpring, BondedContact> simple_laws{RepulsiveSpring(1), BondedContact(1, 0.2)};

TEST(GeneralContacts, MoveAsSimpleBondsDo) {
    const Packing packing = loose_packing();
    const GeneralContact law(unit_model());
    ParticleSystem general(packing.cell, packing.positions, packing.radii, skin);
    ParticleSystem simple = general;
    general.use_general_contacts(true);
    const ContactNetwork bonds = find_contacts(packing, 0.05);
    general.add_bonds(bonds, [&](const Eigen::Vector3d& branch, double first, double second) {
        return law.make_bond(branch, first, second, first + second);
    });
    simple.add_bonds(bonds);
    const Eigen::Matrix3Xd velocities = 0.02 * noise(packing.size(), 1);
    const Eigen::Matrix3Xd spins = 0.02 * noise(packing.size(), 2);
    for (ParticleSystem* system : {&general, &simple}) {
        system->set_velocities(velocities);
        system->set_spins(spins);
    }
    for (int count = 0; count < 200; ++count) {
        step(general, GeneralInteractions{law}, {.time_step = 0.05, .damping = 0.3});
        step(simple, simple_laws, {.time_step = 0.05, .damping = 0.3});
    }
    EXPECT_LT((general.positions() - simple.positions()).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT((general.spins() - simple.spins()).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(CellShear, IsTheSameAsMovingTheParticles) {
    const Packing packing = loose_packing();
    const GeneralContact law(unit_model());
    ParticleSystem system = bonded_system(packing, law);
    const GeneralInteractions laws{law};
    compute_forces(system, laws);
    const double strain = 1e-3;
    system.shear(1, 2, strain);
    compute_forces(system, laws);
    // Force of every bond for affine motion without rotation, by hand.
    Eigen::Matrix3Xd expected = Eigen::Matrix3Xd::Zero(3, packing.size());
    const ContactNetwork bonds = find_contacts(packing, 0.05);
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Eigen::Vector3d branch = bonds.branch.col(bond);
        const Eigen::Vector3d moved(0, strain * branch.z(), 0);
        const Eigen::Vector3d normal = branch.normalized();
        const Eigen::Vector3d force = 0.2 * moved + 0.8 * moved.dot(normal) * normal;
        expected.col(bonds.ends(0, bond)) += force;
        expected.col(bonds.ends(1, bond)) -= force;
        virial += force * branch.transpose();
    }
    EXPECT_LT((system.forces() - expected).cwiseAbs().maxCoeff(), 20 * strain * strain);
    EXPECT_LT((contact_sums(system).virial - virial).cwiseAbs().maxCoeff(), 200 * strain * strain);
    EXPECT_GT(virial(1, 2), 1000 * strain * strain);
}

/// Large shear passes through cells that repeat the lattice; distances must not notice how the cell is described.
TEST(CellShear, FindsAllNeighboursAtAnyStrain) {
    const Packing packing = loose_packing();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, skin);
    const GeneralContact law(unit_model());
    for (int count = 0; count < 90; ++count) {
        system.shear(0, 1, 0.05);
        system.refresh();
        if (count % 10 != 9) {
            continue;
        }
        const Eigen::Matrix3Xd positions = system.positions();
        EXPECT_LT(std::abs(system.cell_shear().strain), 0.75);  // half a period and what one list lasts
        Index expected = 0;
        for (Index i = 0; i < packing.size(); ++i) {
            for (Index j = i + 1; j < packing.size(); ++j) {
                for (int image = 0; image < 125; ++image) {
                    const Eigen::Vector3i periods(image % 5 - 2, image / 5 % 5 - 2, image / 25 - 2);
                    const Eigen::Vector3d shift =
                        system.cell_shear().apply(periods.cast<double>().cwiseProduct(packing.cell.lengths()));
                    const double distance = (positions.col(j) + shift - positions.col(i)).norm();
                    expected += distance < packing.radii[i] + packing.radii[j] ? 1 : 0;
                }
            }
        }
        Index found = 0;
        for (Chunk& chunk : system.chunks()) {
            detail::prepare<false>(system.slots(), chunk);
            found += static_cast<Index>(detail::find_touching(system.slots(), chunk));
        }
        EXPECT_EQ(found, expected) << "strain " << 0.05 * (count + 1);
    }
}

TEST(CellShear, KeepsTheImagesOfBonds) {
    const Packing packing = loose_packing();
    const GeneralContact law(unit_model());
    ParticleSystem system = bonded_system(packing, law);
    const ContactNetwork before = system.bond_network();
    for (int count = 0; count < 300; ++count) {
        system.shear(2, 0, 0.01);
        system.refresh();
    }
    const ContactNetwork after = system.bond_network();
    ASSERT_EQ(after.size(), before.size());
    for (const Bond& bond : system.bonds()) {
        // The affine image of a branch at the start.
        double nearest = 1e9;
        for (Index old = 0; old < before.size(); ++old) {
            Eigen::Vector3d branch = before.branch.col(old);
            branch.z() += 3 * branch.x();
            for (Index now = 0; now < after.size(); ++now) {
                if (after.ends.col(now) == before.ends.col(old) && after.ends(0, now) == std::min(bond.first, bond.second)) {
                    nearest = std::min(nearest, (after.branch.col(now) - branch).norm());
                }
            }
        }
        EXPECT_LT(nearest, 1e-11);
    }
}

TEST(ParticleState, GoesOnToTheSameBits) {
    const Packing packing = loose_packing();
    ContactModel model = unit_model();
    model.friction = 0.4;
    model.normal_strength = 0.002;
    model.normal_viscosity = 0.1;
    GeneralContact law(model);
    ParticleSystem system = bonded_system(packing, law);
    const GeneralInteractions laws{law, 0.05};
    const auto run = [&](ParticleSystem& moving, int from, int to) {
        for (int count = from; count < to; ++count) {
            step(moving, laws, {.time_step = 0.05, .damping = 0.2});
            break_bonds(moving, law);
            moving.shear(0, 2, 2e-3);
            if (count == 100) {
                moving.restore(moving.state());
            }
        }
    };
    run(system, 0, 101);
    const ParticleState saved = system.state();
    run(system, 101, 300);
    ParticleSystem restarted(packing.cell, packing.positions, packing.radii, skin);
    restarted.use_general_contacts(true);
    restarted.restore(saved);
    run(restarted, 101, 300);
    EXPECT_EQ(restarted.positions(), system.positions());
    EXPECT_EQ(restarted.spins(), system.spins());
    Index unbonded = 0;
    for (const Bond& contact : system.bonds()) {
        unbonded += contact.memory.bonded ? 0 : 1;
    }
    EXPECT_GT(unbonded, 0);
    EXPECT_LT(static_cast<Index>(system.bonds().size()) - unbonded, find_contacts(packing, 0.05).size());
}

TEST(ParticleState, OfOtherParticlesIsRefused) {
    const Packing packing = loose_packing();
    ParticleSystem system(packing.cell, packing.positions, packing.radii, skin);
    ParticleState state = system.state();
    state.position.pop_back();
    EXPECT_THROW(system.restore(state), std::invalid_argument);
}

/// Work of the moving cell less what is stored, in motion, dissipated and lost, over the largest work of a cycle.
double imbalance(double time_step, const ContactModel& model) {
    const Packing packing = random_packing(Cell::periodic({5, 5, 5}), 40, 0.6, 0.9, 3);
    GeneralContact law(model);
    ParticleSystem system = bonded_system(packing, law);
    const GeneralInteractions laws{law, time_step};
    const double amplitude = 0.2;
    const int steps = static_cast<int>(std::lround(400 / time_step));
    double work = 0;
    double spent = 0;
    double largest_work = 0;
    double virial_before = 0;
    double increment_before = 0;
    double energy = 0;
    for (int count = 0; count <= steps; ++count) {
        const double kinetic_before = kinetic_energy(system);
        step(system, laws, {.time_step = time_step});
        const ContactSums sums = contact_sums(system);
        work += 0.5 * (sums.virial(0, 2) + virial_before) * increment_before;
        largest_work = std::max(largest_work, work);
        spent += sums.dissipated;
        energy = potential_energy(system, laws) + 0.5 * (kinetic_before + kinetic_energy(system));
        for (const BrokenBond& bond : break_bonds(system, law)) {
            spent += bond.lost;
            energy -= bond.lost;
        }
        virial_before = sums.virial(0, 2);
        const auto strain = [&](int k) { return amplitude * std::sin(2 * M_PI * k / steps); };
        increment_before = strain(count + 1) - strain(count);
        system.shear(0, 2, increment_before);
    }
    EXPECT_GT(spent, 0.003 * largest_work);
    return (work - spent - energy) / largest_work;
}

TEST(GeneralContacts, BalanceTheEnergyOfACycle) {
    ContactModel model = unit_model();
    model.bending_stiffness = 0.05;
    model.twisting_stiffness = 0.02;
    model.friction = 0.3;
    const double coarse = std::abs(imbalance(0.02, model));
    const double fine = std::abs(imbalance(0.005, model));
    EXPECT_LT(fine, 0.15 * coarse);  // of second order
    EXPECT_LT(fine, 1e-6);
    // The force of dashpots and bonds that vanish acts until the middle of the next step: an error of first order.
    model.normal_viscosity = 0.5;
    model.shear_viscosity = 0.3;
    model.normal_strength = 0.05;
    EXPECT_LT(std::abs(imbalance(0.005, model)), 0.3 * std::abs(imbalance(0.02, model)));
    EXPECT_LT(std::abs(imbalance(0.005, model)), 3e-4);
}

/// A chain of three links breaks when its ends are 3 F / k farther apart than at rest; the link that breaks loses F^2 / (2 k).
TEST(GeneralContacts, BreakAChainAtItsStrength) {
    Packing chain{Cell::periodic({20, 20, 20}), Eigen::Matrix3Xd(3, 4), Eigen::VectorXd::Ones(4)};
    for (int link = 0; link < 4; ++link) {
        chain.positions.col(link) = Eigen::Vector3d(4 + 2 * link, 10, 10);
    }
    ContactModel model = unit_model();
    model.normal_strength = 0.01;
    GeneralContact law(model);
    ParticleSystem system = bonded_system(chain, law);
    system.hold({0, 3});
    const double time_step = 0.1;
    const double speed = 1e-5;
    system.set_velocity({3}, {speed, 0, 0});
    for (int count = 0; count < 100000; ++count) {
        step(system, GeneralInteractions{law, time_step}, {.time_step = time_step, .damping = 0.2});
        const std::vector<BrokenBond> broken = break_bonds(system, law);
        if (!broken.empty()) {
            EXPECT_NEAR(count * time_step * speed, 3 * 0.01, 3 * 0.01 * 2e-3);
            EXPECT_NEAR(broken[0].lost, 0.5 * 0.01 * 0.01, 1e-7);
            return;
        }
    }
    FAIL() << "the chain did not break";
}

/// Two bonded particles, one held, the other moved or turned a little at a time until the bond breaks.
BreakageCause cause_of_breakage(const ContactModel& model, const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) {
    Packing pair{Cell::periodic({20, 20, 20}), Eigen::Matrix3Xd(3, 2), Eigen::VectorXd::Ones(2)};
    pair.positions << 9, 11, 10, 10, 10, 10;
    GeneralContact law(model);
    ParticleSystem system = bonded_system(pair, law);
    system.hold({0, 1});
    system.set_velocity({1}, velocity);
    Eigen::Matrix3Xd spins = Eigen::Matrix3Xd::Zero(3, 2);
    spins.col(1) = spin;
    for (int count = 0; count < 1000; ++count) {
        system.set_spins(spins);
        step(system, GeneralInteractions{law}, {.time_step = 0.1});
        const std::vector<BrokenBond> broken = break_bonds(system, law);
        if (!broken.empty()) {
            return broken[0].cause;
        }
    }
    ADD_FAILURE() << "the bond did not break";
    return BreakageCause::normal;
}

TEST(GeneralContacts, SayWhyABondBroke) {
    ContactModel model = unit_model();
    model.bending_stiffness = 1;
    model.twisting_stiffness = 1;
    model.normal_strength = 0.01;
    model.shear_strength = 0.01;
    model.bending_strength = 0.01;
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    EXPECT_EQ(cause_of_breakage(model, {0.01, 0, 0}, none), BreakageCause::normal);
    EXPECT_EQ(cause_of_breakage(model, {0, 0.01, 0}, none), BreakageCause::shear);
    EXPECT_EQ(cause_of_breakage(model, none, {0.01, 0, 0}), BreakageCause::bending);
    EXPECT_EQ(cause_of_breakage(model, none, {0, 0, 0.01}), BreakageCause::bending);
    model = {.young_modulus = 1, .poisson_ratio = 0.3, .work_of_adhesion = 1e-3};
    EXPECT_EQ(cause_of_breakage(model, {0.01, 0, 0}, none), BreakageCause::pull_off);
}

TEST(Held, ParticlesMoveAsTold) {
    const Packing packing = loose_packing();
    const GeneralContact law(unit_model());
    ParticleSystem system = bonded_system(packing, law);
    system.hold({3, 7});
    system.set_velocity({3}, {0.1, 0, 0});
    const Eigen::Matrix3Xd before = system.positions();
    for (int count = 0; count < 10; ++count) {
        step(system, GeneralInteractions{law}, {.time_step = 0.1, .damping = 0.5});
    }
    const Eigen::Matrix3Xd after = system.positions();
    EXPECT_LT((packing.cell.minimum_image(after.col(3) - before.col(3)) - Eigen::Vector3d(0.1, 0, 0)).norm(), 1e-14);
    EXPECT_EQ(after.col(7), before.col(7));
    EXPECT_GT((packing.cell.minimum_image(after.col(8) - before.col(8))).norm() + rms_force(system), 0);
}

}  // namespace
}  // namespace coagula::dem
