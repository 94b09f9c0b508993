// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/contact_memory.hpp>

namespace coagula {

namespace {

/// The vector turned by a small angle, correct to second order.
Eigen::Vector3d turned(const Eigen::Vector3d& vector, const Eigen::Vector3d& turn) {
    return vector + turn.cross(vector + 0.5 * turn.cross(vector));
}

}  // namespace

ContactIncrement advance(ContactMemory& memory, const PairMotion& motion) {
    ContactIncrement now;
    now.distance = motion.branch.norm();
    now.normal = motion.branch / now.distance;
    now.first_lever = now.distance * motion.first_radius / (motion.first_radius + motion.second_radius);
    now.second_lever = now.distance - now.first_lever;

    const Eigen::Vector3d moved = motion.branch - memory.branch;
    const Eigen::Vector3d axis = (0.5 / now.distance) * (motion.branch + memory.branch);
    now.displacement = moved - (now.first_lever * motion.first_turn + now.second_lever * motion.second_turn).cross(axis);
    // Turn of the contact plane, and of the pair about its axis.
    const Eigen::Vector3d turn =
        axis.cross(moved) / now.distance + (0.5 * (motion.first_turn + motion.second_turn).dot(axis)) * axis;

    // What is added in the motion turns by half of it.
    const Eigen::Vector3d half_turned = now.displacement + 0.5 * turn.cross(now.displacement);
    const auto in_plane = [&](const Eigen::Vector3d& vector) -> Eigen::Vector3d {
        return vector - vector.dot(now.normal) * now.normal;
    };
    now.shear_growth = in_plane(half_turned);
    memory.shear = in_plane(turned(memory.shear, turn)) + now.shear_growth;
    const Eigen::Vector3d bend = motion.second_turn - motion.first_turn;
    memory.bend = turned(memory.bend, turn) + bend + 0.5 * turn.cross(bend);
    memory.maxwell = turned(memory.maxwell, turn) + half_turned;
    memory.branch = motion.branch;
    return now;
}

}  // namespace coagula
