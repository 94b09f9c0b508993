// SPDX-License-Identifier: GPL-3.0-or-later
// Force evaluation: loops over pairs and bonds, templates over the contact law.
#pragma once

#include <coagula/common/contact_law.hpp>
#include <coagula/common/dem/kernels.hpp>
#include <coagula/common/dem/particle_system.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>

namespace coagula::dem {

/// A force along the line of centres that depends on the overlap alone: RepulsiveSpring, BondSpring.
template <class Law>
concept CentralLaw = requires(const Law& law, double overlap) {
    { law.force(overlap) } -> std::convertible_to<double>;
    { law.energy(overlap) } -> std::convertible_to<double>;
};

/// A force that depends on the displacement at the contact point, shear included: BondedContact. It turns particles.
template <class Law>
concept ShearLaw = requires(const Law& law, const Eigen::Vector3d& displacement, const Eigen::Vector3d& normal) {
    { law.force(displacement, normal) } -> std::convertible_to<Eigen::Vector3d>;
    { law.energy(displacement, normal) } -> std::convertible_to<double>;
};

/// Who acts: unbonded pairs through `contact`, which must vanish without overlap, and bonds through `bond`.
template <CentralLaw ContactLaw, class BondLaw>
struct Interactions {
    ContactLaw contact;
    BondLaw bond;
    bool bond_on_touch = false;  ///< unbonded particles that come to overlap are bonded from then on, rest length r_i + r_j

    /// Whether moments act.
    static constexpr bool turns = ShearLaw<BondLaw>;
};

namespace detail {

inline std::size_t at(std::int32_t slot) {
    return static_cast<std::size_t>(slot);
}

/// Copies the particles into their ghosts and clears the forces.
template <bool Turns>
void prepare(Slots& slots, const Chunk& chunk) {
    for (std::size_t ghost = at(chunk.own_end); ghost < at(chunk.end); ++ghost) {
        slots.position[ghost] = slots.position[at(slots.source[ghost])] + slots.shift[ghost];
    }
    for (std::size_t slot = at(chunk.begin); slot < at(chunk.end); ++slot) {
        slots.force[slot].setZero();
    }
    if constexpr (Turns) {
        for (std::size_t ghost = at(chunk.own_end); ghost < at(chunk.end); ++ghost) {
            slots.turn[ghost] = slots.turn[at(slots.source[ghost])];
        }
        for (std::size_t slot = at(chunk.begin); slot < at(chunk.end); ++slot) {
            slots.moment[slot].setZero();
        }
    }
}

/// Lists the pairs of the chunk that overlap; returns their number.
inline std::size_t find_touching(const Slots& slots, Chunk& chunk) {
    static_assert(sizeof(SlotPair) == 2 * sizeof(std::int32_t));
    chunk.touching.resize(chunk.pairs.size());
    if (chunk.pairs.empty()) {
        return 0;
    }
    return fastest_kernels().find_touching(slots.position.data()->data(), &chunk.pairs.data()->first, chunk.pairs.size(), 0.0,
                                           chunk.touching.data());
}

/// Chooses the pairs that are nearer than `near_skin`.
inline void choose_near(const Slots& slots, Chunk& chunk, double near_skin) {
    chunk.near_numbers.resize(chunk.pairs.size());
    chunk.near.clear();
    if (!chunk.pairs.empty()) {
        chunk.near_numbers.resize(fastest_kernels().find_touching(slots.position.data()->data(), &chunk.pairs.data()->first,
                                                                  chunk.pairs.size(), near_skin, chunk.near_numbers.data()));
    }
    for (const std::int32_t number : chunk.near_numbers) {
        chunk.near.push_back(chunk.pairs[at(number)]);
    }
    chunk.near_stale = false;
}

/// The same pairs as find_touching() lists, in the same order.
inline std::size_t find_touching_near(const Slots& slots, Chunk& chunk, double near_skin) {
    if (chunk.near_stale) {
        choose_near(slots, chunk, near_skin);
    }
    chunk.touching.resize(chunk.near.size());
    if (chunk.near.empty()) {
        return 0;
    }
    const std::size_t count = fastest_kernels().find_touching(slots.position.data()->data(), &chunk.near.data()->first,
                                                              chunk.near.size(), 0.0, chunk.touching.data());
    for (std::size_t entry = 0; entry < count; ++entry) {
        chunk.touching[entry] = chunk.near_numbers[at(chunk.touching[entry])];
    }
    return count;
}

/// Moves the first `count` touching pairs to the bonds.
inline void bond_touching(const Slots& slots, Chunk& chunk, std::size_t count) {
    if (count == 0) {
        return;
    }
    chunk.near_stale = true;
    std::size_t kept = at(chunk.touching[0]);
    std::size_t next = 0;
    for (std::size_t number = kept; number < chunk.pairs.size(); ++number) {
        const SlotPair pair = chunk.pairs[number];
        if (next < count && at(chunk.touching[next]) == number) {
            const Quad& first = slots.position[at(pair.first)];
            const Quad& second = slots.position[at(pair.second)];
            const Eigen::Vector3d branch = (second - first).template head<3>();
            chunk.bonds.push_back({pair, first[3] + second[3], Eigen::Vector3d::Zero(), branch});
            ++next;
        } else {
            chunk.pairs[kept++] = pair;
        }
    }
    chunk.pairs.resize(kept);
}

/// Force on the first end of a pair that pushes it away from the second; zero for coincident centres.
template <CentralLaw Law>
Quad central_force(const Law& law, const Quad& separation, double rest_length) {
    const double distance = std::sqrt(separation.template head<3>().squaredNorm());
    return (-law.force(rest_length - distance) / std::max(distance, 1e-300)) * separation;
}

template <CentralLaw Law>
void add_contact_forces(Slots& slots, Chunk& chunk, const Law& law, bool bond_on_touch, double near_skin) {
    const std::size_t count = near_skin > 0 ? find_touching_near(slots, chunk, near_skin) : find_touching(slots, chunk);
    for (std::size_t entry = 0; entry < count; ++entry) {
        const SlotPair pair = chunk.pairs[at(chunk.touching[entry])];
        Quad separation = slots.position[at(pair.second)] - slots.position[at(pair.first)];
        const double reach = slots.position[at(pair.second)][3] + slots.position[at(pair.first)][3];
        separation[3] = 0;
        const Quad force = central_force(law, separation, reach);
        slots.force[at(pair.first)] += force;
        slots.force[at(pair.second)] -= force;
    }
    if (bond_on_touch) {
        bond_touching(slots, chunk, count);
    }
}

template <CentralLaw Law>
void add_bond_forces(Slots& slots, Chunk& chunk, const Law& law) {
    chunk.extremes = {};
    for (std::size_t bond = 0; bond < chunk.bonds.size(); ++bond) {
        const SlotPair ends = chunk.bonds.ends(bond);
        Quad separation = slots.position[at(ends.second)] - slots.position[at(ends.first)];
        separation[3] = 0;
        const double distance = std::sqrt(separation.template head<3>().squaredNorm());
        const double stretch = distance - chunk.bonds.rest_length(bond);
        const Quad force = (-law.force(-stretch) / std::max(distance, 1e-300)) * separation;
        slots.force[at(ends.first)] += force;
        slots.force[at(ends.second)] -= force;
        chunk.extremes.stretch = std::max(chunk.extremes.stretch, stretch);
    }
}

inline SlotArrays arrays_of(Slots& slots) {
    return {slots.position.data()->data(), slots.turn.data()->data(), slots.force.data()->data(), slots.moment.data()->data()};
}

template <ShearLaw Law>
void add_bond_forces(Slots& slots, Chunk& chunk, const Law& law) {
    using Vector = BondFormulas<OneLane>::Vector;
    const auto force = [&](double stretch, const Vector& shear, const Vector& normal) -> Vector {
        const Eigen::Vector3d direction(normal.x, normal.y, normal.z);
        const Eigen::Vector3d pull = law.force(stretch * direction + Eigen::Vector3d(shear.x, shear.y, shear.z), direction);
        return {pull[0], pull[1], pull[2]};
    };
    chunk.extremes = add_bond_forces<OneLane, OneLane>(arrays_of(slots), chunk.bonds.blocks(), chunk.bonds.size(), force);
}

/// Linear springs: as many bonds at a time as the processor can.
inline void add_bond_forces(Slots& slots, Chunk& chunk, const BondedContact& law) {
    const SpringForce springs{law.normal_stiffness(), law.shear_stiffness()};
    chunk.extremes = fastest_kernels().add_spring_forces(arrays_of(slots), chunk.bonds.blocks(), chunk.bonds.size(), springs);
}

template <class Laws>
void evaluate(Slots& slots, Chunk& chunk, const Laws& laws, double near_skin) {
    prepare<Laws::turns>(slots, chunk);
    // Bonds first: a touching pair that becomes a bond has its force from the contact in this evaluation.
    add_bond_forces(slots, chunk, laws.bond);
    add_contact_forces(slots, chunk, laws.contact, laws.bond_on_touch, near_skin);
}

/// Adds to the forces (or moments) on the own slots of a chunk what acts on their ghosts, in a fixed order.
inline void collect(const Slots& slots, const Chunk& chunk, std::vector<Quad>& values) {
    for (std::size_t entry = chunk.handed_begin; entry < chunk.handed_end; ++entry) {
        values[at(slots.handed[entry].first)] += values[at(slots.handed[entry].second)];
    }
}

template <bool Turns>
void collect_all(Slots& slots, const Chunk& chunk) {
    collect(slots, chunk, slots.force);
    if constexpr (Turns) {
        collect(slots, chunk, slots.moment);
    }
}

/// With fewer chunks a step is over before a second thread has been woken.
inline constexpr std::ptrdiff_t fewest_parallel_chunks = 6;

/// Runs `work(chunk)` for all chunks in parallel; chunks do not write to each other's slots within one call.
template <class Work>
void for_each_chunk(ParticleSystem& system, Work&& work, bool backwards = false) {
    std::vector<Chunk>& chunks = system.chunks();
    const auto count = static_cast<std::ptrdiff_t>(chunks.size());
#pragma omp parallel for schedule(dynamic) if (count >= fewest_parallel_chunks)
    for (std::ptrdiff_t chunk = 0; chunk < count; ++chunk) {
        work(chunks[static_cast<std::size_t>(backwards ? count - 1 - chunk : chunk)]);
    }
}

}  // namespace detail

/// Evaluates forces and moments at the present positions and leaves them in the system.
template <class Laws>
void compute_forces(ParticleSystem& system, const Laws& laws) {
    system.refresh();
    Slots& slots = system.slots();
    detail::for_each_chunk(system, [&](Chunk& chunk) { detail::evaluate(slots, chunk, laws, system.near_skin()); });
    detail::for_each_chunk(system, [&](Chunk& chunk) {
        detail::collect_all<Laws::turns>(slots, chunk);
        for (std::size_t slot = detail::at(chunk.begin); slot < detail::at(chunk.own_end); ++slot) {
            slots.turn[slot].setZero();  // now contained in the shear displacements
        }
    });
}

/// Energy stored in contacts and bonds [J] at the last force evaluation.
template <class Laws>
double potential_energy(const ParticleSystem& system, const Laws& laws) {
    const Slots& slots = system.slots();
    double energy = 0;
    const auto separation = [&](const SlotPair& pair) {
        const Quad shift = slots.shift[detail::at(pair.second)];
        const std::size_t source = detail::at(slots.source[detail::at(pair.second)]);
        const Quad& first = slots.position[detail::at(pair.first)];
        return Eigen::Vector3d((slots.position[source] + shift - first).template head<3>());
    };
    for (const Chunk& chunk : system.chunks()) {
        for (const SlotPair& pair : chunk.pairs) {
            const double reach = slots.position[detail::at(pair.first)][3] + slots.position[detail::at(pair.second)][3];
            energy += laws.contact.energy(reach - separation(pair).norm());
        }
        for (const SlotBond& bond : chunk.bonds) {
            const Eigen::Vector3d branch = separation(bond.ends);
            const double stretch = branch.norm() - bond.rest_length;
            if constexpr (Laws::turns) {
                const Eigen::Vector3d normal = branch.normalized();
                energy += laws.bond.energy(stretch * normal + bond.shear, normal);
            } else {
                energy += laws.bond.energy(-stretch);
            }
        }
    }
    return energy;
}

/// Energy of motion of translation and rotation [J].
inline double kinetic_energy(const ParticleSystem& system) {
    const Slots& slots = system.slots();
    double energy = 0;
    for (const Chunk& chunk : system.chunks()) {
        for (std::size_t slot = detail::at(chunk.begin); slot < detail::at(chunk.own_end); ++slot) {
            if (slots.inverse_mass[slot] == 0) {
                continue;  // held
            }
            energy += 0.5 * slots.velocity[slot].squaredNorm() / slots.inverse_mass[slot];
            energy += 0.5 * slots.spin[slot].squaredNorm() / slots.inverse_inertia[slot];
        }
    }
    return energy;
}

}  // namespace coagula::dem
