#include <coagula/common/dem/general_forces.hpp>

namespace coagula::dem {

namespace {

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

std::vector<BrokenBond> break_bonds(ParticleSystem& system, const GeneralContact& law) {
    std::vector<BrokenBond> broken;
    const Slots& slots = system.slots();
    for_each_contact(system, [&](SlotContact& contact, double first_radius, double second_radius) {
        if (law.load_ratio(contact.memory, first_radius, second_radius) > 1) {
            const Eigen::Vector3d branch = contact.memory.branch;
            const double lost = law.break_bond(contact.memory, first_radius, second_radius);
            broken.push_back(
                {slots.particle[detail::at(contact.ends.first)], slots.particle[detail::at(contact.ends.second)], branch, lost});
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
