// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula {
namespace {

using Eigen::Vector3d;

/// A bond between unequal particles that has been sheared, bent and stretched.
ContactMemory loaded_memory() {
    ContactMemory memory;
    memory.branch = {1.1, -0.4, 0.7};
    const Vector3d normal = memory.branch.normalized();
    memory.shear = Vector3d(0.02, 0.01, 0.03);
    memory.shear -= memory.shear.dot(normal) * normal;
    memory.bend = {-0.01, 0.02, 0.005};
    memory.maxwell = {0.01, 0.03, -0.02};
    return memory;
}

PairMotion rotation_of(const ContactMemory& memory, const Vector3d& turn) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    return {rotation * memory.branch, turn, turn, 0.8, 0.5};
}

/// How far the vectors are from having turned with the pair.
double rotation_error(double angle) {
    const Vector3d turn = angle * Vector3d(0.3, 0.5, -0.8).normalized();
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, turn.normalized()).toRotationMatrix();
    const ContactMemory before = loaded_memory();
    ContactMemory after = before;
    const ContactIncrement increment = advance(after, rotation_of(before, turn));
    return increment.displacement.norm() + (after.shear - rotation * before.shear).norm() +
           (after.bend - rotation * before.bend).norm() + (after.maxwell - rotation * before.maxwell).norm();
}

TEST(ContactMemory, TurnsWithThePairToThirdOrder) {
    for (const double angle : {0.2, 0.05, 0.01}) {
        EXPECT_LT(rotation_error(angle), angle * angle * angle);
        EXPECT_NEAR(rotation_error(angle) / rotation_error(angle / 2), 8.0, 0.3) << angle;
    }
}

TEST(ContactMemory, ManySmallTurnsMakeAWholeOne) {
    ContactMemory memory = loaded_memory();
    const ContactMemory before = memory;
    constexpr int steps = 2000;
    const Vector3d turn = (2 * EIGEN_PI / steps) * Vector3d(0.3, 0.5, -0.8).normalized();
    for (int step = 0; step < steps; ++step) {
        advance(memory, rotation_of(memory, turn));
    }
    EXPECT_LT((memory.branch - before.branch).norm(), 1e-12);
    EXPECT_LT((memory.shear - before.shear).norm(), 1e-5 * before.branch.norm());
    EXPECT_LT((memory.bend - before.bend).norm(), 1e-5 * before.bend.norm());
}

TEST(ContactMemory, SmallMotionIsTheKinematicsOfTheLinearSolver) {
    const ContactMemory start = [] {
        ContactMemory memory;
        memory.branch = {1.1, -0.4, 0.7};
        return memory;
    }();
    const double scale = 1e-6;
    const Vector3d moved = scale * Vector3d(0.3, 0.9, -0.5);
    const Vector3d first_turn = scale * Vector3d(-0.7, 0.2, 0.4);
    const Vector3d second_turn = scale * Vector3d(0.1, -0.6, 0.5);
    ContactMemory memory = start;
    const ContactIncrement increment = advance(memory, {start.branch + moved, first_turn, second_turn, 0.8, 0.5});
    const double distance = start.branch.norm();
    const Vector3d normal = start.branch / distance;
    const Vector3d lever_turn = distance / 1.3 * (0.8 * first_turn + 0.5 * second_turn);
    const Vector3d delta = moved - lever_turn.cross(normal);
    EXPECT_LT((increment.displacement - delta).norm(), 4 * scale * scale);
    EXPECT_LT((memory.shear - (delta - delta.dot(normal) * normal)).norm(), 4 * scale * scale);
    EXPECT_LT((memory.bend - (second_turn - first_turn)).norm(), 4 * scale * scale);
    EXPECT_DOUBLE_EQ(increment.first_lever + increment.second_lever, memory.branch.norm());
    EXPECT_NEAR(increment.first_lever / increment.second_lever, 1.6, 1e-12);
}

TEST(ContactMemory, ThereAndBackLeavesNothing) {
    ContactMemory memory = loaded_memory();
    const ContactMemory before = memory;
    const Vector3d turn(0.01, -0.02, 0.015);
    advance(memory, {before.branch + Vector3d(0.02, 0.03, -0.01), turn, -2 * turn, 0.8, 0.5});
    EXPECT_GT((memory.shear - before.shear).norm(), 0.01);
    advance(memory, {before.branch, -turn, 2 * turn, 0.8, 0.5});
    EXPECT_LT((memory.shear - before.shear).norm(), 1e-3 * before.shear.norm());
    EXPECT_LT((memory.bend - before.bend).norm(), 1e-3 * before.bend.norm());
}

}  // namespace
}  // namespace coagula
