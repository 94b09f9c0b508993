// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/relax.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include "example_systems.hpp"

namespace coagula::dem {
namespace {

/// Four unit spheres on a tetrahedron of edge 2 + stretch, in SI size.
Packing tetrahedron(double stretch) {
    constexpr double r0 = 0.25e-6;
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(20 * r0)), Eigen::Matrix3Xd(3, 4), Eigen::VectorXd::Constant(4, r0)};
    packing.positions << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
    packing.positions *= (2 + stretch) / std::sqrt(8.0) * r0;
    packing.positions.array() += 0.1 * r0;  // across the boundary
    for (auto position : packing.positions.colwise()) {
        position = packing.cell.wrap(position);
    }
    return packing;
}

TEST(Relax, BringsBondsToTheirRestLengthByEachMethod) {
    for (const RelaxMethod method : {RelaxMethod::fire, RelaxMethod::damped, RelaxMethod::stopped_steps}) {
        for (const double stretch : {-0.1, 0.015}) {
            const Packing packing = tetrahedron(stretch);
            RelaxOptions options;
            options.method = method;
            options.shear_stiffness = 5;
            options.tolerance = 1e-9;
            const Relaxation relaxed = relax(packing, find_contacts(packing, 0.01), options);
            ASSERT_TRUE(relaxed.converged);
            ASSERT_EQ(relaxed.bonds.size(), 6);
            EXPECT_LT((relaxed.bonds.branch.colwise().norm().array() / 0.5e-6 - 1).abs().maxCoeff(), 2e-9);
        }
    }
}

TEST(Relax, LetsFireFinishWhatDampedStepsBegan) {
    const Packing packing = tetrahedron(-0.1);
    RelaxOptions options;
    options.method = RelaxMethod::damped;
    options.shear_stiffness = 5;
    options.tolerance = 1e-12;
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const Relaxation damped = relax(packing, bonds, options);
    options.fire_below = 1e-6;
    const Relaxation finished = relax(packing, bonds, options);
    ASSERT_TRUE(finished.converged);
    EXPECT_LT(finished.iterations, damped.iterations);
    EXPECT_LT((finished.packing.positions - damped.packing.positions).cwiseAbs().maxCoeff(), 1e-12 * 0.25e-6 * 10);
}

TEST(Relax, KeepsThePackingWithoutForcesAsItIs) {
    const Packing packing = tetrahedron(0.005);
    const Relaxation relaxed = relax(packing, ContactNetwork{4, {}, {}});
    EXPECT_TRUE(relaxed.converged);
    EXPECT_EQ(relaxed.iterations, 1);
    EXPECT_LT((relaxed.packing.positions - packing.positions).cwiseAbs().maxCoeff(), 1e-20);
}

TEST(Relax, PushesUnbondedOverlapsApartAndBondsThemIfAsked) {
    const Packing packing = tetrahedron(-0.05);
    for (const bool bond : {false, true}) {
        RelaxOptions options;
        options.bond_on_touch = bond;
        const Relaxation relaxed = relax(packing, ContactNetwork{4, {}, {}}, options);
        EXPECT_TRUE(relaxed.converged);
        EXPECT_EQ(relaxed.bonds.size(), bond ? 6 : 0);
        EXPECT_EQ(find_pairs(relaxed.packing, 0.5e-6 * (1 - 1e-6)).size(), 0);
    }
}

TEST(Relax, SaysWhenItDidNotConverge) {
    const Packing packing = tetrahedron(-0.05);
    RelaxOptions options;
    options.max_iterations = 3;
    EXPECT_FALSE(relax(packing, find_contacts(packing, 0.01), options).converged);
}

TEST(Relax, CanBeCancelled) {
    const Packing packing = tetrahedron(-0.05);
    const Progress progress([](std::string_view, double, std::string_view) { return false; });
    EXPECT_THROW(relax(packing, find_contacts(packing, 0.01), {}, progress), Cancelled);
}

TEST(Relax, IsEqualBitForBitForAnyNumberOfThreads) {
    const Packing packing = random_packing(Cell::periodic({26, 26, 26}), 4000, 0.8, 1.0, 31);
    const auto run = [&](int threads) {
        const int usual = omp_get_max_threads();
        omp_set_num_threads(threads);
        RelaxOptions options;
        options.shear_stiffness = 5;
        options.bond_on_touch = true;
        options.tolerance = 1e-3;
        const Relaxation relaxed = relax(packing, find_contacts(packing, -0.2), options);
        omp_set_num_threads(usual);
        return std::tuple(relaxed.packing.positions, relaxed.iterations, relaxed.rms_force);
    };
    const auto one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(3));
}

TEST(Relax, RejectsImpossibleOptions) {
    const Packing packing = tetrahedron(0);
    RelaxOptions options;
    options.normal_stiffness = -1;
    EXPECT_THROW(relax(packing, ContactNetwork{4, {}, {}}, options), std::invalid_argument);
    options = {};
    options.tolerance = 0;
    EXPECT_THROW(relax(packing, ContactNetwork{4, {}, {}}, options), std::invalid_argument);
    EXPECT_THROW(relax(packing, ContactNetwork{5, {}, {}}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::dem
