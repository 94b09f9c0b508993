// SPDX-License-Identifier: GPL-3.0-or-later
// Force evaluation with the general contact law: bonds with moments that may break, contacts with friction that come and go.
#pragma once

#include <coagula/common/dem/forces.hpp>
#include <coagula/common/general_contact.hpp>

namespace coagula::dem {

/// Viscous fluid around the particles in simple shear: drag on each (Stokes), and films that pairs squeeze (leading term of
/// Jeffrey and Onishi 1984, 6 pi eta R*^2 / gap).
struct Solvent {
    double viscosity = 0;           ///< [Pa s]; 0: there is none
    double lubrication_gap = 0;     ///< gaps count as this at least [m]
    double lubrication_cutoff = 0;  ///< pairs with a smaller gap squeeze a film [m]; 0: none do
    int direction = 0;
    int normal = 2;
    double shear_rate = 0;     ///< [1/s]
    bool cell_moves = true;    ///< velocities are those beyond the flow, as in a sheared cell; else the fluid is at rest at ...
    double resting_plane = 0;  ///< ... this height along the normal [m]
};

/// Bonds and touching contacts of the general law, in a system that uses general contacts, and the solvent.
struct GeneralInteractions {
    GeneralContact law;
    double time_step = 0;  ///< between evaluations [s], for dashpots and Maxwell elements; 0: they and the solvent take no part
    Solvent solvent = {};

    static constexpr bool turns = true;
};

namespace detail {

/// A pair's motion since its memory was brought up to date.
inline PairMotion motion_of(const Slots& slots, const SlotPair& ends) {
    const std::size_t i = at(ends.first);
    const std::size_t j = at(ends.second);
    return {(slots.position[j] - slots.position[i]).template head<3>(), slots.turn[i].template head<3>(),
            slots.turn[j].template head<3>(), slots.position[i][3], slots.position[j][3]};
}

/// Adds the force of a contact to its ends.
inline void apply(Slots& slots, const SlotPair& ends, const PairMotion& motion, const ContactForce& contact) {
    const std::size_t i = at(ends.first);
    const std::size_t j = at(ends.second);
    const double share = motion.first_radius / (motion.first_radius + motion.second_radius);
    const Eigen::Vector3d torque = motion.branch.cross(contact.force);
    slots.force[i].template head<3>() += contact.force;
    slots.force[j].template head<3>() -= contact.force;
    slots.moment[i].template head<3>() += share * torque + contact.moment;
    slots.moment[j].template head<3>() += (1 - share) * torque - contact.moment;
}

/// Touching pairs become contacts.
inline void make_contacts(const Slots& slots, Chunk& chunk, const GeneralContact& law) {
    const std::size_t count = find_touching(slots, chunk);
    for (std::size_t entry = count; entry-- > 0;) {
        const auto place = static_cast<std::ptrdiff_t>(chunk.touching[entry]);
        const SlotPair ends = chunk.pairs[at(chunk.touching[entry])];
        const PairMotion motion = motion_of(slots, ends);
        chunk.contacts.push_back(
            {ends, law.make_contact(motion.branch, motion.first_radius, motion.second_radius), Eigen::Vector3d::Zero()});
        chunk.pairs.erase(chunk.pairs.begin() + place);
    }
}

/// Broken bonds and contacts without bond that have parted become ordinary pairs.
inline void part_contacts(const Slots& slots, Chunk& chunk) {
    std::erase_if(chunk.contacts, [&](const SlotContact& contact) {
        const bool parted = !GeneralContact::touches(contact.memory, slots.position[at(contact.ends.first)][3],
                                                     slots.position[at(contact.ends.second)][3]);
        if (parted) {
            chunk.pairs.push_back(contact.ends);
        }
        return parted;
    });
}

/// Drag on the own particles of a chunk.
void add_drag(Slots& slots, Chunk& chunk, const Solvent& solvent, double time_step);

/// Forces of the films of a chunk's pairs, touching or not.
void add_films(Slots& slots, Chunk& chunk, const Solvent& solvent, double time_step);

template <>
inline void evaluate(Slots& slots, Chunk& chunk, const GeneralInteractions& laws, double /*near_skin*/) {
    prepare<true>(slots, chunk);
    chunk.dissipated = 0;
    chunk.virial.setZero();
    make_contacts(slots, chunk, laws.law);
    for (SlotContact& contact : chunk.contacts) {
        const PairMotion motion = motion_of(slots, contact.ends);
        const ContactForce force = laws.law.update(contact.memory, motion, laws.time_step);
        apply(slots, contact.ends, motion, force);
        contact.force = force.force;
        chunk.dissipated += force.dissipated;
        chunk.virial += force.force * motion.branch.transpose();
    }
    chunk.films.clear();
    if (laws.solvent.viscosity > 0 && laws.time_step > 0) {
        add_drag(slots, chunk, laws.solvent, laws.time_step);
        add_films(slots, chunk, laws.solvent, laws.time_step);
    }
    part_contacts(slots, chunk);
}

}  // namespace detail

/// A bond that broke.
struct BrokenBond {
    std::int32_t first;
    std::int32_t second;
    Eigen::Vector3d branch;  ///< when it broke [m]
    double lost;             ///< energy [J]
    BreakageCause cause;
};

/// Breaks every bond that is above a strength at the last force evaluation; in the order of the chunks.
std::vector<BrokenBond> break_bonds(ParticleSystem& system, const GeneralContact& law);

/// The age of all contacts becomes `factor`, forces stay; returns the energy lost [J].
double set_age(ParticleSystem& system, GeneralContact& law, double factor);

/// Energy in the springs at the last force evaluation [J].
double potential_energy(const ParticleSystem& system, const GeneralInteractions& interactions);

/// Sum over contacts and films of force on the first particle times branch, and energy dissipated by contacts and solvent since the
/// evaluation before, at the last one [J].
struct ContactSums {
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();
    double dissipated = 0;
};
ContactSums contact_sums(const ParticleSystem& system);

}  // namespace coagula::dem
