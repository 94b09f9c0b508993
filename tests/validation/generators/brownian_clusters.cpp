// SPDX-License-Identifier: GPL-3.0-or-later
// Equipartition of clusters whose contacts resist sliding and rolling: energies of the springs against the matrices of their
// stiffness. Units in the names: mean radius, kB T, R^2/D.
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <array>
#include <cstdio>
#include <numeric>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;
using examples::thermal;

constexpr double rest_gap = 0.004;
constexpr double normal_stiffness = 4e5;  // of the contact, kB T/R^2
constexpr double sliding_stiffness = 1e5;
constexpr double rolling_stiffness = 2e5;

/// Touching spheres, every pair of them in contact: two, three in a triangle, four in a tetrahedron. Loops of contacts cannot all
/// roll freely, so that sliding and rolling share their modes.
Eigen::Matrix3Xd cluster(int spheres) {
    Eigen::Matrix3Xd corners(3, 4);
    corners << 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, -1, -1;
    const double edge = (corners.col(0) - corners.col(1)).norm();
    return (2 + rest_gap) / edge * corners.leftCols(spheres);
}

Packing lattice_of_clusters(int side, const Eigen::Matrix3Xd& shape) {
    constexpr double spacing = 8;
    const Index spheres = shape.cols();
    const Index clusters = Index{side} * side * side;
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(spacing * side * radius)), Eigen::Matrix3Xd(3, spheres * clusters),
                    Eigen::VectorXd::Constant(spheres * clusters, radius)};
    for (int number = 0; number < clusters; ++number) {
        const Eigen::Array3i place(number % side, number / side % side, number / side / side);
        const Eigen::Vector3d centre = spacing * (place.cast<double>() + 0.5).matrix();
        const auto key = static_cast<std::uint64_t>(number);
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(
            Eigen::Vector3d::UnitX(), random_normal(7, RandomPurpose::test, 0, key).normalized());
        packing.positions.middleCols(spheres * number, spheres) = radius * ((turn.toRotationMatrix() * shape).colwise() + centre);
    }
    return packing;
}

/// Stiffness matrices of the sliding, rolling and normal springs of a cluster, by displacement and rotation of each sphere.
struct Stiffness {
    Eigen::MatrixXd sliding, rolling, normal;

    explicit Stiffness(const Eigen::Matrix3Xd& shape) {
        const Index freedoms = 6 * shape.cols();
        sliding = rolling = normal = Eigen::MatrixXd::Zero(freedoms, freedoms);
        for (Index second = 0; second < shape.cols(); ++second) {
            for (Index first = 0; first < second; ++first) {
                add(first, second, shape.col(second) - shape.col(first));
            }
        }
    }

    /// Mean energy of springs of this stiffness in the thermal motion of all, over kB T: half the trace of the covariance times it.
    double energy_of(const Eigen::MatrixXd& part) const {
        const Eigen::MatrixXd all = sliding + rolling + normal;
        const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(all);
        return 0.5 * (solver.pseudoInverse() * part).trace();
    }

    int modes() const {
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(sliding + rolling + normal).eigenvalues();
        return static_cast<int>((values.array() > 1e-6 * values.maxCoeff()).count());
    }

private:
    void add(Index first, Index second, const Eigen::Vector3d& branch) {
        const Eigen::Vector3d along = branch.normalized();
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
        Eigen::Matrix3d turn;  // x -> x cross along
        turn << 0, along.z(), -along.y(), -along.z(), 0, along.x(), along.y(), -along.x(), 0;
        const double lever = branch.norm() / 2;
        Eigen::MatrixXd stretch = Eigen::MatrixXd::Zero(3, sliding.cols());
        stretch.middleCols<3>(6 * first) = -Eigen::Matrix3d::Identity();
        stretch.middleCols<3>(6 * second) = Eigen::Matrix3d::Identity();
        Eigen::MatrixXd slip = stretch;
        slip.middleCols<3>(6 * first + 3) = -lever * turn;
        slip.middleCols<3>(6 * second + 3) = -lever * turn;
        Eigen::MatrixXd roll = Eigen::MatrixXd::Zero(3, sliding.cols());
        roll.middleCols<3>(6 * first + 3) = -Eigen::Matrix3d::Identity();
        roll.middleCols<3>(6 * second + 3) = Eigen::Matrix3d::Identity();
        const double moment = rolling_stiffness / 4;  // per angle, at the reduced radius 1/2
        normal += normal_stiffness * stretch.transpose() * along * along.transpose() * stretch;
        sliding += sliding_stiffness * slip.transpose() * across * slip;
        rolling += moment * roll.transpose() * across * roll;
    }
};

double late_mean(const std::vector<double>& values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    return std::accumulate(half, values.end(), 0.0) / static_cast<double>(values.end() - half);
}

/// Every mode of the springs holds kB T/2, however it is made of sliding, rolling and normal displacements.
TEST(BrownianClusters, SlidingAndRollingShareTheirModesAsTheirStiffnessSays) {
    const std::array<int, 5> side = {0, 0, 10, 9, 8};
    for (int spheres = 2; spheres <= 4; ++spheres) {
        const Eigen::Matrix3Xd shape = cluster(spheres);
        const Stiffness stiffness(shape);
        const int contacts = spheres * (spheres - 1) / 2;
        // Twisting is free: only pairs can do it, as the rotations of others are held by contacts in other directions.
        ASSERT_EQ(stiffness.modes(), 6 * (spheres - 1) - (spheres == 2 ? 1 : 0));
        const Packing start = lattice_of_clusters(side[static_cast<std::size_t>(spheres)], shape);
        const double unit = thermal / (radius * radius);
        const double tau = examples::diffusion_time();
        BrownianOptions options;
        options.resistance = {.tangential_stiffness = sliding_stiffness * unit, .rolling_stiffness = rolling_stiffness * unit};
        options.stop_time = 4e-3 * tau;
        options.sample_interval = 5e-5 * tau;
        const BrownianRun run = simulate_brownian(start, dlvo(0), options);
        const double count = static_cast<double>(start.size()) / spheres * thermal;
        const double sliding = late_mean(run.series.sliding_energy) / count;
        const double rolling = late_mean(run.series.rolling_energy) / count;
        const double exact_sliding = stiffness.energy_of(stiffness.sliding);
        const double exact_rolling = stiffness.energy_of(stiffness.rolling);
        std::printf("%d spheres, %d contacts, %d modes: energy over kB T sliding %.3f (exact %.3f), rolling %.3f (exact %.3f)\n",
                    spheres, contacts, stiffness.modes(), sliding, exact_sliding, rolling, exact_rolling);
        EXPECT_NEAR(sliding / exact_sliding, 1, 0.02);
        EXPECT_NEAR(rolling / exact_rolling, 1, 0.02);
    }
}

}  // namespace
}  // namespace coagula::generators
