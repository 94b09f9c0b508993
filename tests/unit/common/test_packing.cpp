// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>

#include "support/complaint.hpp"

#include <gtest/gtest.h>

#include <ctime>

namespace coagula {
namespace {

using testing::complaint;

/// Points in a cube of this edge whose lower corner is at `lower`.
Packing random_points(Index particles, double edge, const Cell& cell, const Eigen::Vector3d& lower, std::uint64_t seed) {
    Packing packing{cell, Eigen::Matrix3Xd(3, particles), Eigen::VectorXd::Ones(particles)};
    for (Index i = 0; i < particles; ++i) {
        const Eigen::Vector3d point = random_uniform(seed, RandomPurpose::test, 0, static_cast<std::uint64_t>(i));
        packing.positions.col(i) = cell.wrap(lower + edge * point);
    }
    return packing;
}

TEST(CheckPacking, FindsWhatTheCellListFinds) {
    // Centres that are the same are nearer than 1e-6 radii; here one cloud of ten has such a pair every other time, also through
    // the faces of the periodic box.
    const Eigen::Vector3d lengths(10.1, 10.2, 10.3);
    int found = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        for (const Cell& cell : {Cell::periodic(lengths), Cell::open(Eigen::Vector3d::Zero(), lengths)}) {
            const Packing packing = random_points(10, 5e-6, cell, Eigen::Vector3d::Constant(-2.5e-6), seed);
            const bool same = find_pairs(packing, 1e-6).size() > 0;
            EXPECT_EQ(complaint([&] { check(packing, "p"); }).find("have the same centre") != std::string::npos, same) << seed;
            found += same ? 1 : 0;
        }
    }
    EXPECT_GT(found, 100);
    EXPECT_LT(found, 300);
}

TEST(CheckPacking, TakesNoSquareOfTheParticlesWhereOneIsFarAway) {
    const double far = 1e6;
    Packing packing = random_points(200000, 1000, Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(far)),
                                    Eigen::Vector3d::Zero(), 1);
    packing.positions.col(7).setConstant(far);
    const std::clock_t start = std::clock();
    EXPECT_EQ(complaint([&] { check(packing); }), "");
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 3);
}

TEST(CheckPacking, RefusesLengthsWhoseCubesAreNoNumbers) {
    EXPECT_EQ(complaint([] { Cell::periodic(Eigen::Vector3d::Constant(1e-150)); }),
              "the volume of the box is 0 m^3, but must be finite and positive");
    EXPECT_EQ(complaint([] { Cell::periodic(Eigen::Vector3d::Constant(1e150)); }),
              "the volume of the box is inf m^3, but must be finite and positive");
    Packing packing = random_points(2, 1, Cell::periodic(Eigen::Vector3d::Ones()), Eigen::Vector3d::Zero(), 1);
    packing.radii.setConstant(1e-150);
    EXPECT_EQ(complaint([&] { check(packing, "p"); }), "p: the volume of the spheres is 0 m^3, but must be finite and positive");
    packing.radii.setConstant(1e-107);
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(1000));
    EXPECT_EQ(complaint([&] { check(packing, "p"); }), "p: the volume fraction is 0, but must be finite and positive");
}

}  // namespace
}  // namespace coagula
