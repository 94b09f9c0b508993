// SPDX-License-Identifier: GPL-3.0-or-later
// How the forces of the contacts of a network change with the motion of their particles.
#include "sheared_network.hpp"

#include <coagula/common/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::mechanics {

namespace {

using Eigen::Vector3d;

/// Steps of the difference quotients of the contact law, in mean radii and radians: small where the law has kinks.
constexpr double largest_difference = 1e-5;
constexpr double smallest_difference = 1e-8;  // of a bond; the largest of a contact without one
constexpr double least_difference = 1e-13;    // of that: distances are rounded

}  // namespace

/// Bonds with linear springs are smooth; Hertz's law is over distances of the order of the overlap; contacts may slip, and must not
/// open on the way.
double ShearedNetwork::difference_step(const ContactMemory& memory) const {
    const double overlap = std::abs(memory.rest_length - memory.branch.norm()) / length_;
    if (!memory.bonded) {
        return std::clamp(0.5 * overlap, least_difference, smallest_difference);
    }
    if (std::isnan(law_.model().young_modulus)) {
        return largest_difference;
    }
    return std::clamp(0.01 * overlap, smallest_difference, largest_difference);
}

std::vector<Slope> ShearedNetwork::linearise(const Trial& trial) const {
    std::vector<Slope> slopes(contacts_.size());
    const auto count = static_cast<Index>(contacts_.size());
#pragma omp parallel for schedule(static) if (worth_threads(count, 1000))
    for (Index k = 0; k < count; ++k) {
        slopes[static_cast<std::size_t>(k)] = slope_of(k, trial);
    }
    return slopes;
}

Slope ShearedNetwork::slope_of(Index k, const Trial& trial) const {
    const ShearedContact& contact = contacts_[static_cast<std::size_t>(k)];
    const ContactMemory& moved_memory = trial.memory[static_cast<std::size_t>(k)];
    const PairMotion base = pair_motion(contact, trial.strain_increment, trial.motion);
    Slope slope = Slope::Zero();
    if (!GeneralContact::touches(moved_memory, base.first_radius, base.second_radius)) {
        return slope;
    }
    const double difference = difference_step(moved_memory);
    const auto moved = [&](int column, double step) {
        PairMotion motion = base;
        Vector3d& part = column < 3 ? motion.branch : (column < 6 ? motion.first_turn : motion.second_turn);
        part[column % 3] += step * (column < 3 ? length_ : 1.0);
        ContactMemory memory = contact.memory;
        const ContactForce force = law_.update(memory, motion, 0.0);
        return wrench(memory, force, contact);
    };
    for (int column = 0; column < 9; ++column) {
        slope.col(column) = (moved(column, difference) - moved(column, -difference)) / (2 * difference);
    }
    slope.bottomRows<6>() *= -1;
    return slope;
}

ContactModes ShearedNetwork::modes_of(Index k, const Trial& trial, bool turns) const {
    const ShearedContact& contact = contacts_[static_cast<std::size_t>(k)];
    const Vector3d branch = trial.memory[static_cast<std::size_t>(k)].branch / length_;
    const double share = radii_[contact.first] / (radii_[contact.first] + radii_[contact.second]);
    Eigen::Matrix3d turn;  // branch x
    turn << 0, -branch.z(), branch.y(), branch.z(), 0, -branch.x(), -branch.y(), branch.x(), 0;
    ContactModes modes = ContactModes::Zero(9, turns ? 6 : 3);
    modes.leftCols<3>() << Eigen::Matrix3d::Identity(), -share * turn, (share - 1) * turn;
    if (turns) {
        modes.block<3, 3>(3, 3) = -Eigen::Matrix3d::Identity();
        modes.block<3, 3>(6, 3) = Eigen::Matrix3d::Identity();
    }
    return modes;
}

}  // namespace coagula::mechanics
