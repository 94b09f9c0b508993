// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/general_forces.hpp>

#include <coagula/common/contact_model.hpp>

#include <numbers>

namespace coagula::dem {

namespace {

/// Velocity of the fluid relative to the frame in which particle velocities are given.
Eigen::Vector3d flow_at(const Solvent& solvent, const Quad& position) {
    Eigen::Vector3d flow = Eigen::Vector3d::Zero();
    if (!solvent.cell_moves) {
        flow[solvent.direction] = solvent.shear_rate * (position[solvent.normal] - solvent.resting_plane);
    }
    return flow;
}

/// Half the curl of the flow.
Eigen::Vector3d spin_of_flow(const Solvent& solvent) {
    return 0.5 * solvent.shear_rate * Eigen::Vector3d::Unit(solvent.normal).cross(Eigen::Vector3d::Unit(solvent.direction));
}

/// Calls visit(contact, first radius, second radius) for all contacts, chunk by chunk.
template <class System, class Visit>
void for_each_contact(System& system, Visit&& visit) {
    const Slots& slots = system.slots();
    for (auto& chunk : system.chunks()) {
        for (auto& contact : chunk.contacts) {
            visit(contact, slots.position[detail::at(contact.ends.first)][3], slots.position[detail::at(contact.ends.second)][3]);
        }
    }
}

}  // namespace

namespace detail {

void add_drag(Slots& slots, Chunk& chunk, const Solvent& solvent, double time_step) {
    const Eigen::Vector3d rotation = spin_of_flow(solvent);
    for (std::size_t slot = at(chunk.begin); slot < at(chunk.own_end); ++slot) {
        if (slots.inverse_mass[slot] == 0) {
            continue;  // held
        }
        const double radius = slots.position[slot][3];
        const Eigen::Vector3d slip = slots.velocity[slot].head<3>() - flow_at(solvent, slots.position[slot]);
        const Eigen::Vector3d spin = slots.spin[slot].head<3>() - rotation;
        const double translation = solvent.viscosity * translation_drag(radius);
        const double turning = solvent.viscosity * rotation_drag(radius);
        slots.force[slot].head<3>() -= translation * slip;
        slots.moment[slot].head<3>() -= turning * spin;
        chunk.dissipated += time_step * (translation * slip.squaredNorm() + turning * spin.squaredNorm());
    }
}

void add_films(Slots& slots, Chunk& chunk, const Solvent& solvent, double time_step) {
    const auto squeeze = [&](const SlotPair& ends) {
        const Quad& first = slots.position[at(ends.first)];
        const Quad& second = slots.position[at(ends.second)];
        const Eigen::Vector3d branch = (second - first).head<3>();
        const double distance = branch.norm();
        const double gap = distance - first[3] - second[3];
        if (gap >= solvent.lubrication_cutoff) {
            return;
        }
        const auto velocity = [&](std::int32_t slot) { return slots.velocity[at(slots.source[at(slot)])].head<3>(); };
        Eigen::Vector3d moving = velocity(ends.second) - velocity(ends.first);
        if (solvent.cell_moves) {
            moving[solvent.direction] += solvent.shear_rate * branch[solvent.normal];
        }
        const double radius = first[3] * second[3] / (first[3] + second[3]);
        const double resistance =
            6 * std::numbers::pi * solvent.viscosity * radius * radius / std::max(gap, solvent.lubrication_gap);
        const double speed = moving.dot(branch) / distance;
        const Eigen::Vector3d force = (resistance * speed / distance) * branch;
        chunk.films.push_back({ends, branch, force});
        slots.force[at(ends.first)].head<3>() += force;
        slots.force[at(ends.second)].head<3>() -= force;
        chunk.virial += force * branch.transpose();
        chunk.dissipated += time_step * resistance * speed * speed;
    };
    if (solvent.lubrication_cutoff > 0) {
        for (const SlotContact& contact : chunk.contacts) {
            squeeze(contact.ends);
        }
        for (const SlotPair& pair : chunk.pairs) {
            squeeze(pair);
        }
    }
}

}  // namespace detail

std::vector<BrokenBond> break_bonds(ParticleSystem& system, const GeneralContact& law) {
    std::vector<BrokenBond> broken;
    const Slots& slots = system.slots();
    for_each_contact(system, [&](SlotContact& contact, double first_radius, double second_radius) {
        const BondLoad load = law.load(contact.memory, first_radius, second_radius);
        if (load.ratio > 1) {
            const Eigen::Vector3d branch = contact.memory.branch;
            const double lost = law.break_bond(contact.memory, first_radius, second_radius);
            broken.push_back({slots.particle[detail::at(contact.ends.first)], slots.particle[detail::at(contact.ends.second)],
                              branch, lost, load.limit});
        }
    });
    return broken;
}

double set_age(ParticleSystem& system, GeneralContact& law, double factor) {
    const double before = law.age_factor();
    law.set_age_factor(factor);
    double lost = 0;
    for_each_contact(system, [&](SlotContact& contact, double first_radius, double second_radius) {
        lost += law.reage(contact.memory, before, first_radius, second_radius);
    });
    return lost;
}

double potential_energy(const ParticleSystem& system, const GeneralInteractions& interactions) {
    double energy = 0;
    for_each_contact(system, [&](const SlotContact& contact, double first_radius, double second_radius) {
        energy += interactions.law.energy(contact.memory, first_radius, second_radius);
    });
    return energy;
}

ContactSums contact_sums(const ParticleSystem& system) {
    ContactSums sums;
    for (const Chunk& chunk : system.chunks()) {
        sums.virial += chunk.virial;
        sums.dissipated += chunk.dissipated;
    }
    return sums;
}

}  // namespace coagula::dem
