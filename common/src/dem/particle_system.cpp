// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/particle_system.hpp>

#include <coagula/common/checks.hpp>

#include "chunk_plan.hpp"
#include "neighbour_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace coagula::dem {

namespace {

template <class Value>
std::vector<Value> blank(std::size_t size, const Value& value) {
    return std::vector<Value>(size, value);
}

void resize(Slots& slots, std::size_t size) {
    const Quad zero = Quad::Zero();
    for (auto* values : {&slots.position, &slots.velocity, &slots.force, &slots.spin, &slots.turn, &slots.moment, &slots.reference,
                         &slots.shift}) {
        *values = blank(size, zero);
    }
    slots.inverse_mass = blank(size, 0.0);
    slots.inverse_inertia = blank(size, 0.0);
    slots.particle = blank(size, std::int32_t{-1});
    slots.source = blank(size, std::int32_t{-1});
    slots.images = blank<Eigen::Vector3i>(size, Eigen::Vector3i::Zero());
}

/// Lists which ghost hands its force to which slot, in the order of the receiving slots.
void link_ghosts(Slots& slots, std::vector<Chunk>& chunks) {
    // Where the ghosts of a slot begin in `handed`, and while that is filled, where the next one goes.
    std::vector<std::size_t> start(slots.source.size() + 1, 0);
    const auto for_each_ghost = [&](const auto& visit) {
        for (const Chunk& chunk : chunks) {
            for (std::int32_t ghost = chunk.own_end; ghost < chunk.end; ++ghost) {
                visit(ghost, at(slots.source[at(ghost)]));
            }
        }
    };
    for_each_ghost([&](std::int32_t /*ghost*/, std::size_t source) { ++start[source + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (Chunk& chunk : chunks) {
        chunk.handed_begin = start[at(chunk.begin)];
        chunk.handed_end = start[at(chunk.own_end)];
    }
    slots.handed.resize(start.back());
    for_each_ghost([&](std::int32_t ghost, std::size_t source) {
        slots.handed[start[source]++] = {static_cast<std::int32_t>(source), ghost};
    });
}

/// Writes the message only if it is needed.
double checked_positive(double value, const char* what, Index particle, const char* unit) {
    return value > 0 && std::isfinite(value)
               ? value
               : require_positive(value, std::string("the ") + what + " of particle " + std::to_string(particle), unit);
}

Quad padded(const Eigen::Vector3d& vector) {
    return {vector[0], vector[1], vector[2], 0.0};
}

}  // namespace

// NOLINTNEXTLINE(modernize-pass-by-value): a cell moves no faster than it copies
ParticleSystem::ParticleSystem(const Cell& cell, const Eigen::Matrix3Xd& positions, const Eigen::VectorXd& radii, double skin)
    : cell_(cell), skin_(require_positive(skin, "the skin of the neighbour list", "m")), radii_(radii), list_radii_(radii) {
    require(positions.cols() > 0 && positions.cols() == radii.size(),
            "the particle system has " + std::to_string(positions.cols()) + " positions and " + std::to_string(radii.size()) +
                " radii, but needs at least one particle and as many radii");
    const auto particles = static_cast<std::size_t>(radii.size());
    ParticleState state;
    state.position.resize(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        const auto column = static_cast<Index>(particle);
        state.position[particle] = padded(positions.col(column));
        state.position[particle][3] = require_positive(radii[column], "the radius of particle " + std::to_string(particle), "m");
    }
    for (auto* values : {&state.velocity, &state.spin, &state.turn, &state.force, &state.moment}) {
        values->assign(particles, Quad::Zero());
    }
    state.inverse_mass.assign(particles, 1.0);
    state.inverse_inertia.resize(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        const double radius = state.position[particle][3];
        state.inverse_inertia[particle] = 2.5 / (radius * radius);
    }
    rebuild(std::move(state));
}

ParticleState ParticleSystem::state() const {
    const auto particles = slot_of_.size();
    ParticleState state;
    const auto collect = [&](auto& target, const auto& source) {
        target.resize(particles);
        for (std::size_t particle = 0; particle < particles; ++particle) {
            target[particle] = source[at(slot_of_[particle])];
        }
    };
    collect(state.position, slots_.position);
    collect(state.velocity, slots_.velocity);
    collect(state.spin, slots_.spin);
    collect(state.turn, slots_.turn);
    collect(state.force, slots_.force);
    collect(state.moment, slots_.moment);
    collect(state.inverse_mass, slots_.inverse_mass);
    collect(state.inverse_inertia, slots_.inverse_inertia);
    state.bonds = bonds();
    state.shear = shear_;
    return state;
}

void ParticleSystem::restore(ParticleState state) {
    require(
        state.position.size() == static_cast<std::size_t>(radii_.size()),
        "the state is that of " + std::to_string(state.position.size()) + " particles, not of " + std::to_string(radii_.size()));
    rebuild(std::move(state));
}

/// Takes whole periods out of the shear; bonds name the same images by other numbers.
void ParticleSystem::reduce_shear(ParticleState& state) const {
    CellShear& shear = state.shear;
    if (!cell_.is_rectangular()) {
        return;  // its images after a whole period are no others, but they lie along other edges
    }
    const double period = cell_.lengths()[shear.direction] / cell_.lengths()[shear.normal];
    const double whole = std::nearbyint(shear.strain / period);
    if (whole != 0) {
        shear.strain -= whole * period;
        for (Bond& bond : state.bonds) {
            bond.images[shear.direction] += static_cast<int>(whole) * bond.images[shear.normal];
        }
    }
}

/// Brings all particles into the periodic cell; bonds keep their images.
void ParticleSystem::wrap(ParticleState& state) const {
    std::vector<Eigen::Vector3i> moved(state.position.size());
    for (std::size_t particle = 0; particle < state.position.size(); ++particle) {
        Quad& position = state.position[particle];
        const Eigen::Vector3d before = state.shear.undo(position.head<3>());
        const Eigen::Array3d periods = cell_.fraction(before);
        if (!(periods.abs() < 500).all()) {
            throw std::runtime_error("particle " + std::to_string(particle) +
                                     " has left all bounds: the time step is too large for the stiffness of the contacts");
        }
        const Eigen::Vector3d after = cell_.wrap(before);
        moved[particle] = cell_.in_edges(before - after).array().round().cast<int>();
        if (state.shear.strain == 0) {
            position.head<3>() = after;
        } else if (!moved[particle].isZero()) {
            position.head<3>() -= state.shear.apply(cell_.edges() * moved[particle].cast<double>());
        }
    }
    for (Bond& bond : state.bonds) {
        bond.images += moved[at(bond.second)] - moved[at(bond.first)];
    }
}

/// Searches neighbours in the unsheared cell, with spheres and skin so much larger that no pair of the sheared one is missed.
std::vector<ChunkPlan> ParticleSystem::plan(const ParticleState& state, std::vector<std::int32_t>& order) const {
    const auto search = [&](const std::vector<Quad>& positions, double skin) {
        const NeighbourSearch found(cell_, positions, skin);
        order = found.order();
        return plan_chunks(found, state.bonds);
    };
    if (state.shear.strain == 0) {
        return search(state.position, skin_);
    }
    const double half = 0.5 * std::abs(state.shear.strain);
    const double stretch = half + std::sqrt(1 + half * half);  // largest singular value of a simple shear
    std::vector<Quad> unsheared = state.position;
    for (Quad& position : unsheared) {
        // Inside already, rounding apart.
        const Eigen::Array3d place = cell_.fraction(state.shear.undo(position.head<3>()));
        position.head<3>() = cell_.place(place.max(0.0).min(1 - 1e-15));
        position[3] *= stretch;
    }
    return search(unsheared, skin_ * stretch);
}

Eigen::Vector3d ParticleSystem::image_shift(const Eigen::Vector3i& images) const {
    return shear_.apply(cell_.edges() * images.cast<double>());
}

void ParticleSystem::rebuild(ParticleState state) {
    reduce_shear(state);
    wrap(state);
    shear_ = state.shear;
    std::vector<std::int32_t> order;
    const std::vector<ChunkPlan> plans = plan(state, order);
    lay_out_chunks(plans);
#pragma omp parallel for schedule(dynamic) if (plans.size() > 1)
    for (std::size_t number = 0; number < plans.size(); ++number) {
        const Chunk& chunk = chunks_[number];
        for (std::int32_t slot = chunk.begin; slot < chunk.own_end; ++slot) {
            fill_slot(slot, order[at(plans[number].first + slot - chunk.begin)], state);
        }
    }
#pragma omp parallel for schedule(dynamic) if (plans.size() > 1)
    for (std::size_t number = 0; number < plans.size(); ++number) {
        fill_chunk(chunks_[number], plans[number], order, state.bonds);
    }
    link_ghosts(slots_, chunks_);
    list_radii_ = radii_;
    growth_ = 0;
    list_strain_ = shear_.strain;
    approach_ = 0;
    ++list_builds_;
    forget_near();
}

/// Slots of the chunks one after the other, own before ghosts.
void ParticleSystem::lay_out_chunks(const std::vector<ChunkPlan>& plans) {
    chunks_.assign(plans.size(), Chunk{});
    std::size_t end = 0;
    for (std::size_t number = 0; number < plans.size(); ++number) {
        const ChunkPlan& plan = plans[number];
        Chunk& chunk = chunks_[number];
        chunk.begin = static_cast<std::int32_t>(end);
        chunk.own_end = chunk.begin + plan.last - plan.first;
        end += at(plan.last - plan.first) + plan.ghosts.size();
        require(end < 2000000000U, "the particle system has too many particles for 32-bit slots");
        chunk.end = static_cast<std::int32_t>(end);
    }
    resize(slots_, end);
    slot_of_.resize(static_cast<std::size_t>(size()));
}

void ParticleSystem::fill_slot(std::int32_t own_slot, std::int32_t particle, const ParticleState& state) {
    const std::size_t slot = at(own_slot);
    const std::size_t from = at(particle);
    slot_of_[from] = own_slot;
    slots_.particle[slot] = particle;
    slots_.source[slot] = own_slot;
    slots_.position[slot] = slots_.reference[slot] = state.position[from];
    slots_.velocity[slot] = state.velocity[from];
    slots_.spin[slot] = state.spin[from];
    slots_.turn[slot] = state.turn[from];
    slots_.force[slot] = state.force[from];
    slots_.moment[slot] = state.moment[from];
    slots_.inverse_mass[slot] = state.inverse_mass[from];
    slots_.inverse_inertia[slot] = state.inverse_inertia[from];
}

/// Ghosts, pairs and bonds of a chunk, once all own slots are filled.
void ParticleSystem::fill_chunk(Chunk& chunk, const ChunkPlan& plan, const std::vector<std::int32_t>& order,
                                const std::vector<Bond>& bonds) {
    for (std::size_t ghost = 0; ghost < plan.ghosts.size(); ++ghost) {
        const std::size_t slot = at(chunk.own_end) + ghost;
        const Eigen::Vector3i images = images_in(plan.ghosts[ghost]);
        slots_.particle[slot] = order[at(number_in(plan.ghosts[ghost]))];
        slots_.source[slot] = slot_of_[at(slots_.particle[slot])];
        slots_.images[slot] = images;
        slots_.shift[slot] = padded(image_shift(images));
        slots_.position[slot] = slots_.position[at(slots_.source[slot])] + slots_.shift[slot];
    }
    chunk.pairs.reserve(plan.pairs.size());
    for (const ListedPair& pair : plan.pairs) {
        chunk.pairs.push_back(plan.slots_of(pair, chunk.begin));
    }
    for (std::size_t entry = 0; entry < plan.bonds.size(); ++entry) {
        const Bond& bond = bonds[plan.bond_numbers[entry]];
        const SlotPair ends = plan.slots_of(plan.bonds[entry], chunk.begin);
        if (general_) {
            chunk.contacts.push_back({ends, bond.memory, Eigen::Vector3d::Zero()});
        } else {
            chunk.bonds.push_back({ends, bond.memory.rest_length, bond.memory.shear, bond.memory.branch});
        }
    }
}

/// The chunks know an upper bound of the displacements; measures them before a list is thrown away.
void ParticleSystem::refresh_carefully(double margin) {
    double displacement = 0;
    for (Chunk& chunk : chunks_) {
        double squared = 0;
        for (std::int32_t slot = chunk.begin; slot < chunk.own_end; ++slot) {
            const Quad& reference = slots_.reference[at(slot)];
            Eigen::Vector3d moved = (slots_.position[at(slot)] - reference).head<3>();
            moved[shear_.direction] -= (shear_.strain - list_strain_) * reference[shear_.normal];  // of the cell
            squared = std::max(squared, moved.squaredNorm());
        }
        chunk.path = std::sqrt(squared);
        chunk.near_stale = true;  // the path it was counted by is gone
        displacement = std::max(displacement, chunk.path);
    }
    // Close to the limit measuring would have to be repeated all the time.
    if (!(2 * (displacement + growth_) + approach_ <= 0.9 * (skin_ - listed_gap_ - margin))) {
        rebuild(this->state());
    }
}

/// Like refresh(), for the near pairs.
void ParticleSystem::refresh_near() {
    double path = 0;
    bool stale = false;
    for (const Chunk& chunk : chunks_) {
        path = std::max(path, chunk.path - chunk.near_path);
        stale = stale || chunk.near_stale;
    }
    if (stale || !(2 * (path + near_growth_) + near_approach_ <= near_skin_)) {
        forget_near();
    }
}

/// The next evaluation of forces, at the present positions, chooses the near pairs anew.
void ParticleSystem::forget_near() {
    for (Chunk& chunk : chunks_) {
        chunk.near_stale = true;
        chunk.near_path = chunk.path;
    }
    near_growth_ = 0;
    near_approach_ = 0;
}

void ParticleSystem::set_masses(const Eigen::VectorXd& masses) {
    require(masses.size() == size(), "the particle system has " + std::to_string(size()) + " particles, but " +
                                         std::to_string(masses.size()) + " masses were given");
    for (Index particle = 0; particle < size(); ++particle) {
        const double mass = checked_positive(masses[particle], "mass", particle, "kg");
        const std::size_t slot = at(slot_of_[static_cast<std::size_t>(particle)]);
        slots_.inverse_mass[slot] = 1 / mass;
        slots_.inverse_inertia[slot] = 2.5 / (mass * radii_[particle] * radii_[particle]);
    }
}

void ParticleSystem::set_radii(const Eigen::VectorXd& radii) {
    require(radii.size() == size(), "the particle system has " + std::to_string(size()) + " particles, but " +
                                        std::to_string(radii.size()) + " radii were given");
    near_growth_ += std::max(0.0, (radii - radii_).maxCoeff());
    radii_ = radii;
    growth_ = std::max(0.0, (radii_ - list_radii_).maxCoeff());
    for (Index particle = 0; particle < size(); ++particle) {
        slots_.position[at(slot_of_[static_cast<std::size_t>(particle)])][3] =
            checked_positive(radii[particle], "radius", particle, "m");
    }
}

void ParticleSystem::set_in_slots(std::vector<Quad>& values, const Eigen::Matrix3Xd& given, const char* name) {
    require(given.cols() == size(), "the particle system has " + std::to_string(size()) + " particles, but " +
                                        std::to_string(given.cols()) + " " + name + " were given");
    for (Index particle = 0; particle < size(); ++particle) {
        values[at(slot_of_[static_cast<std::size_t>(particle)])] = padded(given.col(particle));
    }
}

void ParticleSystem::set_velocities(const Eigen::Matrix3Xd& velocities) {
    set_in_slots(slots_.velocity, velocities, "velocities");
}

void ParticleSystem::set_spins(const Eigen::Matrix3Xd& spins) {
    set_in_slots(slots_.spin, spins, "angular velocities");
}

void ParticleSystem::keep_listed(double gap) {
    require(gap >= 0 && gap < skin_, "the gap of listed pairs is " + to_text(gap) + " m, but the skin of the list is " +
                                         to_text(skin_) + " m and must be larger");
    listed_gap_ = gap;
}

void ParticleSystem::set_velocity(const std::vector<Index>& particles, const Eigen::Vector3d& velocity) {
    for (const Index particle : particles) {
        slots_.velocity[at(slot_of_[static_cast<std::size_t>(particle)])] = padded(velocity);
    }
}

void ParticleSystem::shear(int direction, int normal, double increment) {
    require(cell_.is_periodic(), "an open cell cannot be sheared");
    const auto is_axis = [](int axis) { return axis >= 0 && axis < 3; };
    require(is_axis(direction) && is_axis(normal) && direction != normal, "shear needs two different axes of 0, 1, 2");
    require(shear_.strain == 0 || (shear_.direction == direction && shear_.normal == normal),
            "the cell is sheared along other axes already");
    shear_ = {direction, normal, shear_.strain + increment};
    for (const Chunk& chunk : chunks_) {
        for (std::size_t slot = at(chunk.begin); slot < at(chunk.own_end); ++slot) {
            slots_.position[slot][direction] += increment * slots_.position[slot][normal];
        }
        for (std::size_t ghost = at(chunk.own_end); ghost < at(chunk.end); ++ghost) {
            if (slots_.shift[ghost][normal] != 0) {
                slots_.shift[ghost].head<3>() = image_shift(slots_.images[ghost]);
            }
        }
    }
    const double farthest = 2 * radii_.maxCoeff() + skin_;
    approach_ = std::abs(shear_.strain - list_strain_) * farthest;
    near_approach_ += std::abs(increment) * farthest;
}

}  // namespace coagula::dem
