// SPDX-License-Identifier: GPL-3.0-or-later
// A pair of particles that is moved by hand.
#pragma once

#include <coagula/common/general_contact.hpp>

#include <Eigen/Geometry>

namespace coagula::testing {

/// Two unequal particles with a contact, and its forces after each motion.
struct ContactPair {
    GeneralContact law;
    double first_radius = 0.25e-6;
    double second_radius = 0.2e-6;
    ContactMemory memory = {};
    double dissipated = 0;

    static Eigen::Vector3d normal() { return {0.6, -0.48, 0.64}; }
    static Eigen::Vector3d across() { return {0.8, 0.36, -0.48}; }
    double touching_distance() const { return first_radius + second_radius; }
    double effective_radius() const { return first_radius * second_radius / touching_distance(); }

    void bond(double distance) { memory = law.make_bond(distance * normal(), first_radius, second_radius, distance); }
    void touch(double overlap) {
        memory = law.make_contact((touching_distance() - overlap) * normal(), first_radius, second_radius);
    }

    ContactForce move(const Eigen::Vector3d& branch, const Eigen::Vector3d& first_turn, const Eigen::Vector3d& second_turn,
                      double duration = 0) {
        ContactForce result = law.update(memory, {branch, first_turn, second_turn, first_radius, second_radius}, duration);
        dissipated += result.dissipated;
        return result;
    }
    ContactForce stay() { return move(memory.branch, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()); }
    ContactForce stretch(double change, double duration = 0) {
        const Eigen::Vector3d branch = memory.branch + change * memory.branch.normalized();
        return move(branch, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), duration);
    }
    /// Shear along across() by turning both particles alike: the line of centres stays.
    ContactForce slide(double change, double duration = 0) {
        const Eigen::Vector3d turn = (change / memory.branch.norm()) * across().cross(memory.branch.normalized());
        return move(memory.branch, turn, turn, duration);
    }

    double energy() const { return law.energy(memory, first_radius, second_radius); }
    BondLoad load() const { return law.load(memory, first_radius, second_radius); }
    double load_ratio() const { return load().ratio; }
};

}  // namespace coagula::testing
