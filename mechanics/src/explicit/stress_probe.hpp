// SPDX-License-Identifier: GPL-3.0-or-later
// Stress of the particles in the rheometer: whole volume, plate and measurement spheres.
#pragma once

#include "plates.hpp"

#include <coagula/common/dem/forces.hpp>
#include <coagula/common/dem/general_forces.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

/// Calls visit(slot of the first particle, slot of the second, branch, force on the first) for every bond and touching pair, as
/// left by the last force evaluation.
template <class BondLaw, class Visit>
void for_each_force(const dem::ParticleSystem& system, const dem::Interactions<RepulsiveSpring, BondLaw>& laws, Visit&& visit) {
    const dem::Slots& slots = system.slots();
    const auto position = [&](std::int32_t slot) { return slots.position[dem::detail::at(slot)].template head<3>(); };
    for (const dem::Chunk& chunk : system.chunks()) {
        for (const dem::SlotBond& bond : chunk.bonds) {
            const double distance = bond.branch.norm();
            const Eigen::Vector3d normal = bond.branch / distance;
            visit(bond.ends, bond.branch, laws.bond.force((distance - bond.rest_length) * normal + bond.shear, normal));
        }
        for (const dem::SlotPair& pair : chunk.pairs) {
            const Eigen::Vector3d branch = position(pair.second) - position(pair.first);
            const double reach = slots.position[dem::detail::at(pair.first)][3] + slots.position[dem::detail::at(pair.second)][3];
            const double distance = branch.norm();
            if (distance < reach) {
                visit(pair, branch, -laws.contact.force(reach - distance) / distance * branch);
            }
        }
    }
}

template <class Visit>
void for_each_force(const dem::ParticleSystem& system, const dem::GeneralInteractions& /*laws*/, Visit&& visit) {
    for (const dem::Chunk& chunk : system.chunks()) {
        for (const dem::SlotContact& contact : chunk.contacts) {
            visit(contact.ends, contact.memory.branch, contact.force);
        }
        for (const dem::SlotFilm& film : chunk.films) {
            visit(film.ends, film.branch, film.force);
        }
    }
}

/// Stress component [Pa] in all the ways that the rheometer measures it.
struct StressSample {
    double whole = 0;
    double plate = 0;
    Eigen::VectorXd spheres;
    double mean_contact_force = 0;  ///< [N]
};

/// Measures one component of the stress of a mounted sample.
class StressProbe {
public:
    StressProbe(const MountedSample& mounted, const RheometerOptions& options, const ShearOrientation& orientation);

    Index spheres() const { return centres_.cols(); }

    template <class Laws>
    StressSample measure(const dem::ParticleSystem& system, const Laws& laws) const {
        Sums sums{.whole = 0, .spheres = Eigen::VectorXd::Zero(spheres())};
        for_each_force(system, laws, [&](const dem::SlotPair& ends, const Eigen::Vector3d& branch, const Eigen::Vector3d& force) {
            add(system.slots(), ends, branch, force, sums);
        });
        return finish(system, sums);
    }

private:
    struct Sums {
        double whole = 0;
        Eigen::VectorXd spheres;
        double force = 0;
        Index contacts = 0;
    };
    void add(const dem::Slots& slots, const dem::SlotPair& ends, const Eigen::Vector3d& branch, const Eigen::Vector3d& force,
             Sums& sums) const;
    StressSample finish(const dem::ParticleSystem& system, const Sums& sums) const;
    double part_inside(double from, double to) const;
    void place_spheres(const MountedSample& mounted, const RheometerOptions& options);

    ShearOrientation orientation_;
    double bottom_;
    double height_;
    double area_;
    bool has_plates_;
    std::vector<Index> upper_;
    Eigen::Matrix3Xd centres_;                 ///< of the measurement spheres [m]
    Eigen::VectorXd per_volume_;               ///< solid fraction in each over the volume of the particles in it [1/m^3]
    std::vector<std::vector<int>> in_sphere_;  ///< spheres in which the centre of each particle lies
};

}  // namespace coagula::mechanics
