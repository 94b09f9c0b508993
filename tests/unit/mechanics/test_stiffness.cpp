// SPDX-License-Identifier: GPL-3.0-or-later
#include "networks.hpp"
#include "solvers/stiffness.hpp"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <array>

namespace coagula::mechanics {
namespace {

using coagula::testing::alike;
using coagula::testing::bonds_between;
using coagula::testing::random_spheres;

struct MatrixSample {
    Packing packing = random_spheres(30, 6.5, 1.0, 7);
    ContactNetwork bonds;
    LoadBearing kept;
    std::vector<ContactTangent> tangents;  ///< every term, unlike in every bond
    MatrixSample() {
        for (Index i = 0; i < packing.size(); ++i) {  // unlike radii: unlike lever arms
            packing.radii[i] = 0.8 + 0.4 * random_uniform(3, RandomPurpose::test, 1, static_cast<std::uint64_t>(i))[0];
        }
        bonds = find_contacts(packing, 0.2);
        kept = find_load_bearing(bonds);
        for (Index bond = 0; bond < bonds.size(); ++bond) {
            const auto at_random = [&](std::uint64_t purpose) {
                return random_uniform(9, RandomPurpose::test, purpose, static_cast<std::uint64_t>(bond))[0];
            };
            tangents.push_back({.normal = 40 + 20 * at_random(0),
                                .shear = 10 * at_random(1),
                                .bending = 8 * at_random(2),
                                .twisting = 5 * at_random(3),
                                .tension = at_random(4) - 0.2});
        }
    }
    LinearNetwork network() const { return {packing, bonds, kept, tangents, reference}; }
    static constexpr double reference = 50;
};

Eigen::MatrixXd dense(const BlockMatrix& full) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * full.rows(), 6 * full.rows());
    for (Index row = 0; row < full.rows(); ++row) {
        for (Index k = full.start[static_cast<std::size_t>(row)]; k < full.start[static_cast<std::size_t>(row) + 1]; ++k) {
            matrix.block<6, 6>(6 * row, 6 * full.column[static_cast<std::size_t>(k)]) += full.block[static_cast<std::size_t>(k)];
        }
    }
    return matrix;
}

/// Energy of the network straight from the kinematics, bond by bond: lengths in mean radii, stiffness in the reference.
double energy(const MatrixSample& sample, const Eigen::VectorXd& motion, const Eigen::Matrix3d& strain) {
    const double r0 = mean_radius(sample.packing);
    double sum = 0;
    for (const Index bond : sample.kept.bond) {
        const int i = sample.bonds.ends(0, bond);
        const int j = sample.bonds.ends(1, bond);
        const Eigen::Vector3d branch = sample.bonds.branch.col(bond) / r0;
        const Eigen::Vector3d n = branch.normalized();
        const double arm_i = branch.norm() * sample.packing.radii[i] / (sample.packing.radii[i] + sample.packing.radii[j]);
        const double arm_j = branch.norm() - arm_i;
        const Index a = 6 * sample.kept.number[static_cast<std::size_t>(i)];
        const Index b = 6 * sample.kept.number[static_cast<std::size_t>(j)];
        const Eigen::Vector3d turn = arm_i * motion.segment<3>(a + 3) + arm_j * motion.segment<3>(b + 3);
        const Eigen::Vector3d moved = motion.segment<3>(b) - motion.segment<3>(a) + strain * branch;
        const Eigen::Vector3d delta = moved - turn.cross(n);
        const Eigen::Vector3d bend = motion.segment<3>(b + 3) - motion.segment<3>(a + 3);
        const ContactTangent& k = sample.tangents[static_cast<std::size_t>(bond)];
        const auto along = [&](const Eigen::Vector3d& v) { return v.dot(n) * v.dot(n); };
        const auto across = [&](const Eigen::Vector3d& v) { return v.cross(n).squaredNorm(); };
        sum += k.normal * along(delta) + k.shear * across(delta) + k.tension * across(moved);
        sum += (k.twisting * along(bend) + k.bending * across(bend)) / (r0 * r0);
    }
    return 0.5 * sum / MatrixSample::reference;
}

TEST(Stiffness, IsTheSecondDerivativeOfTheEnergy) {
    const MatrixSample sample;
    ASSERT_GT(sample.kept.particle.size(), 20U);
    const Eigen::MatrixXd k = dense(both_triangles(sample.network().stiffness()));
    EXPECT_LT((k - k.transpose()).norm(), 1e-13 * k.norm());
    Eigen::VectorXd motion(k.rows());
    for (Index i = 0; i < motion.size(); ++i) {
        motion[i] = random_normal(5, RandomPurpose::test, 2, static_cast<std::uint64_t>(i))[0];
    }
    EXPECT_NEAR(0.5 * motion.dot(k * motion), energy(sample, motion, Eigen::Matrix3d::Zero()), 1e-12 * motion.dot(k * motion));
}

TEST(Stiffness, LoadsAndAffineEnergyMatchTheEnergyUnderStrain) {
    const MatrixSample sample;
    const LinearNetwork network = sample.network();
    const Loads loads = network.loads();
    const Block affine = network.affine_energy();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(loads.rows());
    constexpr std::array<std::array<int, 2>, 6> pairs = {{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
    for (int strain = 0; strain < 6; ++strain) {
        Eigen::Matrix3d epsilon = Eigen::Matrix3d::Zero();
        const auto [row, column] = pairs[static_cast<std::size_t>(strain)];
        epsilon(row, column) += 0.5;
        epsilon(column, row) += 0.5;
        EXPECT_NEAR(0.5 * affine(strain, strain), energy(sample, zero, epsilon), 1e-12 * affine(strain, strain));
        for (const Index unknown : {Index{0}, Index{4}, Index{17}, loads.rows() - 1}) {
            Eigen::VectorXd step = zero;
            step[unknown] = 1e-4;
            const double slope = (energy(sample, step, epsilon) - energy(sample, -step, epsilon)) / 2e-4;
            EXPECT_NEAR(loads(unknown, strain), -slope, 1e-9) << "unknown " << unknown << ", strain " << strain;
        }
    }
}

TEST(Stiffness, EnergyBondByBondAtAnyMotion) {
    const MatrixSample sample;
    const LinearNetwork network = sample.network();
    Loads motion(6 * network.particles(), 6);
    for (Index i = 0; i < motion.rows(); ++i) {
        motion.row(i).setConstant(random_normal(6, RandomPurpose::test, 3, static_cast<std::uint64_t>(i))[0]);
    }
    const Block energies = network.energy(motion);
    Eigen::Matrix3d shear_xy = Eigen::Matrix3d::Zero();
    shear_xy(0, 1) = shear_xy(1, 0) = 0.5;
    const Eigen::Matrix3d stretch_z = Eigen::Vector3d::UnitZ().asDiagonal();
    EXPECT_NEAR(0.5 * energies(5, 5), energy(sample, motion.col(5), shear_xy), 1e-12 * energies(5, 5));
    EXPECT_NEAR(0.5 * energies(2, 2), energy(sample, motion.col(2), stretch_z), 1e-12 * energies(2, 2));
}

TEST(Stiffness, RigidTranslationGivesNoForceAndRigidRotationOfAClusterNeither) {
    const MatrixSample sample;
    const BlockMatrix full = both_triangles(sample.network().stiffness());
    Loads translation = Loads::Zero(6 * full.rows(), 6);
    for (Index i = 0; i < full.rows(); ++i) {
        translation.block<3, 3>(6 * i, 0).setIdentity();
    }
    Loads force;
    multiply(full, translation, force);
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-12);

    // A cluster that no periodic boundary cuts: all separations are plain differences.
    Packing cluster = random_spheres(6, 3.0, 1.0, 11);
    cluster.cell = Cell::periodic(Eigen::Vector3d::Constant(100.0));
    const auto bonds = find_contacts(cluster, 0.3);
    const LoadBearing kept = find_load_bearing(bonds);
    ASSERT_GE(kept.particle.size(), 4U);
    const LinearNetwork network(cluster, bonds, kept, alike(bonds, {.normal = 50, .shear = 5, .bending = 3, .twisting = 2}), 50);
    Loads rotation = Loads::Zero(6 * network.particles(), 6);
    const Eigen::Vector3d omega(0.3, -0.7, 0.5);
    for (std::size_t place = 0; place < kept.particle.size(); ++place) {
        const Eigen::Vector3d position = cluster.positions.col(kept.particle[place]);
        rotation.block<3, 1>(6 * static_cast<Index>(place), 0) = omega.cross(position);
        rotation.block<3, 1>(6 * static_cast<Index>(place) + 3, 0) = omega;
    }
    multiply(both_triangles(network.stiffness()), rotation, force);  // bending and twisting do not notice it, either
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Stiffness, SpinsOfTwoBondedParticlesAreFreeAndFeelNoLoad) {
    const Packing packing = random_spheres(10, 10.0, 1.0);
    std::vector<std::pair<int, int>> pairs{{0, 5}, {5, 1}};
    for (int i = 0; i < 5; ++i) {
        for (int j = i + 1; j < 5; ++j) {
            pairs.emplace_back(i, j);
        }
    }
    const auto bonds = bonds_between(packing, pairs);
    const LinearNetwork network(packing, bonds, find_load_bearing(bonds), alike(bonds, {.normal = 50, .shear = 5}), 50);
    const BlockMatrix plain = network.stiffness();
    BlockMatrix stiffened = plain;
    EXPECT_EQ(network.stiffen_spins(stiffened), 1);
    const Block added = stiffened.diagonal(5) - BlockMatrix(plain).diagonal(5);
    Eigen::SelfAdjointEigenSolver<Block> modes(added);
    const Eigen::Matrix<double, 6, 1> spin = modes.eigenvectors().col(5);
    EXPECT_NEAR(modes.eigenvalues()[5], 1.0, 1e-14);
    Loads motion = Loads::Zero(6 * network.particles(), 6);
    motion.block<6, 1>(30, 0) = spin;
    Loads force;
    multiply(both_triangles(plain), motion, force);
    EXPECT_LT(force.cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((network.loads().middleRows<6>(30).transpose() * spin).norm(), 1e-13);
}

}  // namespace
}  // namespace coagula::mechanics
