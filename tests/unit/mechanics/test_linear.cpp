// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/linear.hpp>

#include <coagula/mechanics/frequency.hpp>

#include "networks.hpp"
#include "solvers/load_bearing.hpp"
#include "solvers/stiffness.hpp"
#include "support/lattices.hpp"

#include <coagula/generators/void_expansion.hpp>

#include <omp.h>
#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace coagula::mechanics {
namespace {

using coagula::testing::alike;
using coagula::testing::random_spheres;

/// A random network with rattlers, spins and floppy modes, of which a dense solver knows everything.
struct LinearNetworkSample {
    Packing packing = random_spheres(120, 10.0, 1.0e-6, 21);
    ContactNetwork bonds = find_contacts(packing, 0.02);
};

struct DenseAnswer {
    Eigen::Matrix<double, 6, 6> tensor;
    Index zero_modes;
};

/// The same modulus by the eigenvalues of the dense matrix: a pseudo-inverse, without any shift.
DenseAnswer dense_answer(const LinearNetworkSample& sample) {
    const LoadBearing kept = find_load_bearing(sample.bonds);
    const LinearNetwork network(sample.packing, sample.bonds, kept, alike(sample.bonds, {.normal = 50, .shear = 5}), 50);
    const BlockMatrix full = both_triangles(network.stiffness());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6 * full.rows(), 6 * full.rows());
    for (Index row = 0; row < full.rows(); ++row) {
        for (Index e = full.start[static_cast<std::size_t>(row)]; e < full.start[static_cast<std::size_t>(row) + 1]; ++e) {
            k.block<6, 6>(6 * row, 6 * full.column[static_cast<std::size_t>(e)]) = full.block[static_cast<std::size_t>(e)];
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
    const Eigen::MatrixXd f = modes.eigenvectors().transpose() * Eigen::MatrixXd(network.loads());
    Block relaxed = Block::Zero();
    Index zero = 0;
    for (Index mode = 0; mode < f.rows(); ++mode) {
        if (modes.eigenvalues()[mode] < 1e-10) {
            ++zero;
            EXPECT_LT(f.row(mode).norm(), 1e-6) << "a load on a mode without stiffness";
        } else {
            relaxed += f.row(mode).transpose() * f.row(mode) / modes.eigenvalues()[mode];
        }
    }
    const double r0 = mean_radius(sample.packing);
    return {50 * r0 * r0 / sample.packing.cell.volume() * (network.affine_energy() - relaxed), zero};
}

TEST(Linear, AgreesWithTheDensePseudoInverse) {
    const LinearNetworkSample sample;
    const DenseAnswer dense = dense_answer(sample);
    const LinearResponse response = solve_linear(sample.packing, sample.bonds);
    ASSERT_GT(response.rattlers, 0);
    ASSERT_GT(dense.zero_modes, 3);
    EXPECT_LT((response.elastic_tensor - dense.tensor).norm(), 1e-8 * dense.tensor.norm());
    EXPECT_EQ(response.floppy_modes, dense.zero_modes - 3);
    EXPECT_LT(response.residual, 2e-10);
}

TEST(Linear, DoesNotDependOnTheShift) {
    const LinearNetworkSample sample;
    LinearOptions options;
    const auto reference = solve_linear(sample.packing, sample.bonds, options);
    for (const double shift : {1e-7, 1e-9, 1e-11}) {
        options.shift = shift;
        const auto other = solve_linear(sample.packing, sample.bonds, options);
        EXPECT_LT((other.elastic_tensor - reference.elastic_tensor).norm(), 1e-8 * reference.elastic_tensor.norm()) << shift;
    }
}

TEST(Linear, IterativeAndDirectSolversAgree) {
    const Packing packing = random_spheres(700, 17.0, 1.0e-6, 4);
    const auto bonds = find_contacts(packing, 0.05);
    LinearOptions options;
    options.solver = LinearSolver::direct;
    const auto direct = solve_linear(packing, bonds, options);
    options.solver = LinearSolver::iterative;
    options.modulus_tolerance = 1e-8;
    const auto iterative = solve_linear(packing, bonds, options);
    ASSERT_GT(direct.mean_shear_modulus(), 0);
    EXPECT_EQ(iterative.solver_used, LinearSolver::iterative);
    EXPECT_GT(iterative.iterations, 3);
    EXPECT_LT((iterative.elastic_tensor - direct.elastic_tensor).norm(), 1e-6 * direct.elastic_tensor.norm());
}

TEST(Linear, AutomaticChoiceFollowsThePredictedMemory) {
    const LinearNetworkSample sample;
    LinearOptions options;
    const auto direct = solve_linear(sample.packing, sample.bonds, options);
    EXPECT_EQ(direct.solver_used, LinearSolver::direct);
    options.memory_limit = 0.5 * direct.predicted_memory;
    EXPECT_EQ(solve_linear(sample.packing, sample.bonds, options).solver_used, LinearSolver::iterative);
}

TEST(Linear, SameBitsForOneAndTwoThreads) {
    const Packing packing = random_spheres(700, 17.0, 1.0e-6, 4);
    const auto bonds = find_contacts(packing, 0.05);
    for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
        SCOPED_TRACE(solver == LinearSolver::direct ? "direct" : "iterative");
        LinearOptions options;
        options.solver = solver;
        omp_set_num_threads(1);
        const auto one = solve_linear(packing, bonds, options);
        omp_set_num_threads(2);
        const auto two = solve_linear(packing, bonds, options);
        EXPECT_TRUE(one.elastic_tensor == two.elastic_tensor);
        EXPECT_TRUE(one.displacement[5] == two.displacement[5]);
        EXPECT_TRUE(one.rotation[3] == two.rotation[3]);
    }
}

TEST(Linear, ParticleStiffnessesActInSeriesAndModuliScaleWithThem) {
    const LinearNetworkSample sample;
    LinearOptions options;
    const auto base = solve_linear(sample.packing, sample.bonds, options);
    EXPECT_DOUBLE_EQ(base.contact_normal_stiffness, 50);
    EXPECT_DOUBLE_EQ(base.contact_shear_stiffness, 5);
    options.normal_stiffness = 300;
    options.shear_stiffness = 30;
    const auto stiff = solve_linear(sample.packing, sample.bonds, options);
    EXPECT_LT((stiff.elastic_tensor - 3 * base.elastic_tensor).norm(), 1e-8 * stiff.elastic_tensor.norm());
}

TEST(Linear, DisplacementsSolveTheProblemWithoutNetDrift) {
    const LinearNetworkSample sample;
    const auto response = solve_linear(sample.packing, sample.bonds);
    for (const auto& field : response.displacement) {
        EXPECT_LT(field.rowwise().sum().norm(), 1e-9 * field.norm());
        EXPECT_GT(field.norm(), 0);
    }
    EXPECT_LT(response.mean_shear_modulus(), response.mean_affine_modulus());
}

TEST(Linear, NetworkThatCarriesNothingHasModulusZero) {
    const Packing packing = random_spheres(10, 40.0, 1.0e-6, 2);
    const auto none = solve_linear(packing, find_contacts(packing, 0.01));
    EXPECT_EQ(none.rattlers, 10);
    EXPECT_EQ(none.mean_shear_modulus(), 0);
    EXPECT_TRUE(none.elastic_tensor.isZero());

    // A rigid cluster that does not reach around the cell is load-bearing as a graph, but its modulus vanishes.
    Packing cluster = random_spheres(8, 3.0, 1.0e-6, 5);
    cluster.cell = Cell::periodic(Eigen::Vector3d::Constant(50e-6));
    const auto island = solve_linear(cluster, find_contacts(cluster, 0.2));
    EXPECT_LT(island.rattlers, 8);
    EXPECT_LT(island.elastic_tensor.norm(), 1e-9 * island.affine_tensor.norm());
    EXPECT_FALSE(island.elastic_tensor.hasNaN());
}

/// Symmetry cancels the loads of a crystal, and what the digits of a file leave of them hardly sums up to zero.
TEST(Linear, CrystalWithThePlacesOfAFile) {
    const Packing exact = testing::make_lattice(testing::face_centred_cubic(), 4, 4, 4);
    const double modulus = solve_linear(exact, find_contacts(exact, 0.01)).mean_shear_modulus();
    for (int digits = 5; digits <= 14; ++digits) {
        const double unit = std::pow(10.0, -digits) * exact.radii[0];
        const Packing read{exact.cell, unit * (exact.positions / unit).array().round(), exact.radii};
        const ContactNetwork bonds = find_contacts(read, 0.01);
        const LinearResponse response = solve_linear(read, bonds);
        EXPECT_NEAR(response.mean_shear_modulus() / modulus, 1, 10 * std::pow(10.0, -digits) + 1e-12) << digits << " digits";
        const FrequencyPoint point = solve_frequency_sweep(read, bonds, {}, std::array{1.0}, {}).points.at(0);
        EXPECT_LT((point.modulus.real() - response.elastic_tensor).norm(), 1e-9 * modulus) << digits << " digits";
    }
}

/// 44 modes without stiffness and some with hardly any: conjugate gradients come near to the tolerance and then lose what they had.
TEST(Linear, ReachesItsToleranceBesideSoftModes) {
    generators::VoidExpansionOptions expansion;
    expansion.particles = 400;
    expansion.voids = 200;
    expansion.volume_fraction = 0.4;
    expansion.radii = Eigen::VectorXd::Constant(400, 0.25e-6);
    expansion.seed = 10;
    const Packing packing = generators::expand_voids(expansion).packing;
    const ContactNetwork bonds = find_contacts(packing, 0.001);
    const LinearResponse direct = solve_linear(packing, bonds);
    EXPECT_LE(direct.residual, 2e-10);
    LinearOptions options;
    options.solver = LinearSolver::iterative;
    options.modulus_tolerance = 1e-9;
    EXPECT_NEAR(direct.mean_shear_modulus() / solve_linear(packing, bonds, options).mean_shear_modulus(), 1, 1e-7);
}

TEST(Linear, AutomaticChoiceGoesOnIterativelyWhereTheDirectSolverFails) {
    const LinearNetworkSample sample;
    const LinearResponse usual = solve_linear(sample.packing, sample.bonds);
    LinearOptions options;
    options.tolerance = 1e-18;
    const LinearResponse other = solve_linear(sample.packing, sample.bonds, options);
    EXPECT_EQ(usual.solver_used, LinearSolver::direct);
    EXPECT_EQ(other.solver_used, LinearSolver::iterative);
    EXPECT_NEAR(other.mean_shear_modulus() / usual.mean_shear_modulus(), 1, 1e-4);
    options.solver = LinearSolver::direct;
    EXPECT_THROW(solve_linear(sample.packing, sample.bonds, options), std::runtime_error);
}

TEST(Linear, RefusesImpossibleInput) {
    const LinearNetworkSample sample;
    LinearOptions options;
    options.normal_stiffness = -1;
    EXPECT_THROW(solve_linear(sample.packing, sample.bonds, options), std::invalid_argument);
    options = {};
    options.shear_stiffness = unset;
    EXPECT_THROW(solve_linear(sample.packing, sample.bonds, options), std::invalid_argument);
    options = {};
    Packing open = sample.packing;
    open.cell = Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(10e-6));
    EXPECT_THROW(solve_linear(open, sample.bonds, options), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
