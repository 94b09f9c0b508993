// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/particle_system.hpp>

#include <vector>

#include "chunk_plan.hpp"

// Places, motions and forces of the particle system in the caller's particle numbers.

namespace coagula::dem {

Eigen::Matrix3Xd ParticleSystem::in_callers_order(const std::vector<Quad>& values) const {
    Eigen::Matrix3Xd result(3, size());
    for (Index particle = 0; particle < size(); ++particle) {
        result.col(particle) = values[at(slot_of_[static_cast<std::size_t>(particle)])].head<3>();
    }
    return result;
}

Eigen::Matrix3Xd ParticleSystem::positions() const {
    Eigen::Matrix3Xd result = in_callers_order(slots_.position);
    for (auto position : result.colwise()) {
        const Eigen::Vector3d place = cell_.wrap(shear_.undo(position));
        position = shear_.apply(place);
    }
    return result;
}

Eigen::Matrix3Xd ParticleSystem::velocities() const {
    return in_callers_order(slots_.velocity);
}

Eigen::Matrix3Xd ParticleSystem::spins() const {
    return in_callers_order(slots_.spin);
}

Eigen::Matrix3Xd ParticleSystem::forces() const {
    return in_callers_order(slots_.force);
}

Eigen::Matrix3Xd ParticleSystem::moments() const {
    return in_callers_order(slots_.moment);
}

Eigen::Vector3d ParticleSystem::total_force(const std::vector<Index>& particles) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Index particle : particles) {
        sum += slots_.force[at(slot_of_[static_cast<std::size_t>(particle)])].head<3>();
    }
    return sum;
}

void ParticleSystem::hold(const std::vector<Index>& particles) {
    for (const Index particle : particles) {
        const std::size_t slot = at(slot_of_[static_cast<std::size_t>(particle)]);
        slots_.inverse_mass[slot] = 0;
        slots_.inverse_inertia[slot] = 0;
    }
}

}  // namespace coagula::dem
