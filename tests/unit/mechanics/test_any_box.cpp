// SPDX-License-Identifier: GPL-3.0-or-later
// The same network by other edge vectors of the box: mechanics knows images and the volume only.
#include <coagula/mechanics/linear.hpp>

#include "networks.hpp"
#include "support/boxes.hpp"

#include <gtest/gtest.h>

namespace coagula::mechanics {
namespace {

using coagula::testing::random_spheres;
using coagula::testing::skewed;

struct Pair {
    Packing straight = random_spheres(200, 11.5, 1.0e-6, 21);
    Packing tilted = skewed(straight);
};

TEST(AnyBox, HasTheSameElasticTensor) {
    const Pair pair;
    for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::iterative}) {
        LinearOptions options;
        options.solver = solver;
        const LinearResponse straight = solve_linear(pair.straight, find_contacts(pair.straight, 0.2), options);
        const LinearResponse tilted = solve_linear(pair.tilted, find_contacts(pair.tilted, 0.2), options);
        ASSERT_GT(straight.elastic_tensor.diagonal().minCoeff(), 0);
        EXPECT_LT((tilted.elastic_tensor - straight.elastic_tensor).norm(), 1e-6 * straight.elastic_tensor.norm());
        EXPECT_EQ(tilted.rattlers, straight.rattlers);
    }
}

TEST(AnyBox, ChainsResistWhatTheyReachAround) {
    // A straight chain along an edge that leans in the plane of x and y: only a stretch along it costs energy.
    Packing packing;
    packing.cell = Cell::of_edges(Eigen::Vector3d::Zero(), (Eigen::Matrix3d() << 8, 4, 0, 0, 8, 0, 0, 0, 8).finished() * 1e-6,
                                  {true, true, true});
    constexpr Index particles = 5;
    packing.positions.resize(3, particles);
    packing.radii = Eigen::VectorXd::Constant(particles, 0.9e-6);
    for (Index i = 0; i < particles; ++i) {
        packing.positions.col(i) = packing.cell.place({0.5, static_cast<double>(i) / particles, 0.5});
    }
    const LinearResponse response = solve_linear(packing, find_contacts(packing, 0.01));
    const Eigen::Matrix3d edges = packing.cell.edges();
    const Eigen::Vector3d along = edges.col(1).normalized();
    Eigen::Matrix<double, 6, 1> stretch;
    stretch << along[0] * along[0], along[1] * along[1], along[2] * along[2], along[1] * along[2], along[0] * along[2],
        along[0] * along[1];
    const Eigen::Matrix<double, 6, 6> expected = stretch * stretch.transpose();
    const double scale = response.elastic_tensor(1, 1) / expected(1, 1);
    EXPECT_GT(scale, 0);
    EXPECT_LT((response.elastic_tensor - scale * expected).norm(), 1e-6 * scale);
}

}  // namespace
}  // namespace coagula::mechanics
