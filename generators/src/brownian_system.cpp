// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_system.hpp"

#include <coagula/common/cell_list.hpp>
#include <coagula/common/checks.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

constexpr double wide_skin = 0.6;       // of the list of all pairs
constexpr double most_near_skin = 0.3;  // of the list of near pairs
constexpr std::size_t particles_per_chunk = 500;
constexpr std::size_t touching_per_chunk = 2000;  // where contacts resist: those between chunks are computed twice
constexpr std::size_t most_chunks = 64;

/// Calls work(chunk) for all chunks; must be reached by all threads of a parallel region, or by one alone.
template <class Chunks, class Work>
void share_chunks(Chunks& chunks, Work&& work) {
    const auto count = static_cast<std::ptrdiff_t>(chunks.size());
#pragma omp for schedule(static)
    for (std::ptrdiff_t number = 0; number < count; ++number) {
        work(chunks[static_cast<std::size_t>(number)]);
    }
}

}  // namespace

BrownianState initial_state(const Eigen::Matrix3Xd& positions) {
    const Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, positions.cols());
    return {0, positions, positions, positions, 0, 0, none, none, {}};
}

void BrownianSystem::Motion::resize(std::size_t slots) {
    for (std::vector<double>* values : {&start, &noise, &second_noise, &force, &stages[0], &stages[1]}) {
        values->assign(4 * slots, 0.0);
    }
    mobility.assign(slots, 0.0);
    noise_scale.assign(slots, 0.0);
}

StageArrays BrownianSystem::Motion::arrays(std::size_t stage) {
    std::vector<double>& latest = stages[stage % 2];
    std::vector<double>& target = stages[(stage + 1) % 2];
    // The second stage still needs the start; the target of the others holds the stage before the latest.
    return {.before = stage < 2 ? start.data() : target.data(),
            .latest = latest.data(),
            .noise = noise.data(),
            .second_noise = second_noise.data(),
            .noise_scale = noise_scale.data(),
            .force = force.data(),
            .mobility = mobility.data(),
            .target = target.data()};
}

std::vector<double> BrownianSystem::Motion::observed(const BrownianSetup& setup, std::int64_t step, RandomPurpose purpose,
                                                     const std::vector<std::int32_t>& particles) const {
    std::vector<double> shaken(start.size());
    random_normals(setup.seed, purpose, static_cast<std::uint64_t>(step), particles, shaken.data());
    for (std::size_t slot = 0; slot < particles.size(); ++slot) {
        for (std::size_t part = 4 * slot; part < 4 * slot + 3; ++part) {
            shaken[part] = start[part] + setup.scheme.observation * noise_scale[slot] * shaken[part];
        }
    }
    return shaken;
}

/// Finds neighbours in slots.
class PairFinder {
public:
    PairFinder(const Cell& cell, const Eigen::Matrix3Xd& positions, double cutoff)
        : cells(cell, positions, cutoff), slot_of(static_cast<std::size_t>(positions.cols())) {
        for (std::size_t slot = 0; slot < slot_of.size(); ++slot) {
            slot_of[static_cast<std::size_t>(cells.order()[slot])] = static_cast<std::int32_t>(slot);
        }
    }
    CellList cells;
    std::vector<std::int32_t> slot_of;
};

BrownianSystem::BrownianSystem(BrownianSetup setup, const BrownianState& state)
    : setup_(std::move(setup)),
      equal_radii_(setup_.radii.minCoeff() == setup_.radii.maxCoeff()),
      list_skin_(wide_skin),
      reserve_(6 * std::sqrt(2 * setup_.time_step / setup_.radii.minCoeff())),
      // Shorter steps: fewer pairs too many, since less is lost to the reserve.
      near_skin_(std::min(most_near_skin, 0.1 + 5 * reserve_)),
      step_(state.step),
      strain_(state.list_strain) {
    const double reach = setup_.far.last() + list_skin_ + 2 * setup_.radii.maxCoeff();
    require(setup_.period.minCoeff() >= 2 * reach, "the box is " + to_text(setup_.period.minCoeff()) +
                                                       " mean radii wide, but the forces need at least " + to_text(2 * reach) +
                                                       ": take more particles, a smaller volume fraction or a shorter cut-off gap");
    require(2 * reserve_ < near_skin_, "the time step is " + to_text(setup_.time_step) +
                                           " times the diffusion time of a particle, too long for the neighbour list");
    const auto particles = static_cast<std::size_t>(setup_.radii.size());
    const std::size_t in_chunk = setup_.springs.active() ? touching_per_chunk : particles_per_chunk;
    const std::size_t count = std::clamp<std::size_t>(particles / in_chunk, 1, most_chunks);
    chunks_.resize(count);
    for (std::size_t number = 0; number < count; ++number) {
        chunks_[number].begin = number * particles / count;
        chunks_[number].end = (number + 1) * particles / count;
    }
    // Slots as they were when the lists were made; then the present is put in.
    particle_.resize(particles);
    for (std::size_t slot = 0; slot < particles; ++slot) {
        particle_[slot] = static_cast<std::int32_t>(slot);
    }
    translation_.resize(particles);
    if (setup_.springs.active()) {
        rotation_.resize(particles);
        rotation_.start = in_slots(state.rotations);
    }
    set_stage_times();
    translation_.start = in_slots(state.list_reference);
    far_ = in_slots(state.far_forces);
    make_list();
    near_reference_ = in_slots(state.near_reference);
    near_strain_ = state.near_strain;
    choose_near();
    translation_.start = in_slots(state.positions);
    strain_ = next_strain_ = setup_.flow.strain(time());
    place_springs(state.springs);
    for (Chunk& chunk : chunks_) {
        measure_paths(chunk, translation_.start, strain_);
    }
}

std::vector<double> BrownianSystem::in_slots(const Eigen::Matrix3Xd& values) const {
    std::vector<double> slots(4 * particle_.size(), 0.0);
    for (std::size_t slot = 0; slot < particle_.size(); ++slot) {
        Eigen::Vector3d::Map(&slots[4 * slot]) = values.col(particle_[slot]);
    }
    return slots;
}

Eigen::Matrix3Xd BrownianSystem::in_order(const std::vector<double>& slots) const {
    Eigen::Matrix3Xd values(3, static_cast<Index>(particle_.size()));
    for (std::size_t slot = 0; slot < particle_.size(); ++slot) {
        values.col(particle_[slot]) = Eigen::Vector3d::Map(&slots[4 * slot]);
    }
    return values;
}

BrownianState BrownianSystem::state() const {
    return {step_,
            in_order(translation_.start),
            in_order(list_reference_),
            in_order(near_reference_),
            list_strain_,
            near_strain_,
            in_order(far_),
            rotations(),
            springs()};
}

Eigen::Matrix3Xd BrownianSystem::observed_positions() const {
    return in_order(translation_.observed(setup_, step_, RandomPurpose::brownian_observation, particle_));
}

/// Sorts the slots in space and lists all pairs, both at the present positions.
void BrownianSystem::make_list() {
    const Eigen::Matrix3Xd positions = in_order(translation_.start);
    const Eigen::Matrix3Xd far = in_order(far_);
    const Eigen::Matrix3Xd turned = rotations();
    const std::vector<ContactSpring> remembered = springs();
    const double reach = setup_.far.last() + list_skin_ + 2 * setup_.radii.maxCoeff();
    Eigen::Matrix3d edges = setup_.period.asDiagonal();
    edges(0, 2) = lean();
    const PairFinder finder(Cell::of_edges(Eigen::Vector3d::Zero(), edges, {true, true, true}), positions, reach);
    particle_.assign(finder.cells.order().begin(), finder.cells.order().end());
    translation_.start = in_slots(positions);
    far_ = in_slots(far);
    list_reference_ = translation_.start;
    list_strain_ = strain_;
    radius_.resize(particle_.size());
    for (std::size_t slot = 0; slot < particle_.size(); ++slot) {
        radius_[slot] = setup_.radii[particle_[slot]];
        translation_.mobility[slot] = 1 / radius_[slot];
        translation_.noise_scale[slot] = std::sqrt(2 * translation_.mobility[slot] * setup_.time_step);
    }
    if (setup_.springs.active()) {
        rotation_.start = in_slots(turned);
        for (std::size_t slot = 0; slot < particle_.size(); ++slot) {
            // Stokes: 8 pi viscosity R^3 against 6 pi viscosity R.
            rotation_.mobility[slot] = 0.75 / (radius_[slot] * radius_[slot] * radius_[slot]);
            rotation_.noise_scale[slot] = std::sqrt(2 * rotation_.mobility[slot] * setup_.time_step);
        }
    }
#pragma omp parallel
    share_chunks(chunks_, [&](Chunk& chunk) { list_pairs(chunk, finder); });
    near_reference_ = translation_.start;
    near_strain_ = strain_;
    choose_near();
    place_springs(remembered);
}

void BrownianSystem::list_pairs(Chunk& chunk, const PairFinder& finder) const {
    chunk.all.clear(chunk.begin, chunk.end);
    for (std::size_t slot = chunk.begin; slot < chunk.end; ++slot) {
        const Eigen::Vector3d here = Eigen::Vector3d::Map(&translation_.start[4 * slot]);
        const double own_reach = setup_.far.last() + list_skin_ + radius_[slot];
        finder.cells.for_each_near(here, [&](int particle, const Eigen::Vector3d& separation) {
            const std::int32_t other = finder.slot_of[static_cast<std::size_t>(particle)];
            const double reach = own_reach + radius_[static_cast<std::size_t>(other)];
            if (other != static_cast<std::int32_t>(slot) && separation.squaredNorm() <= reach * reach) {
                chunk.all.slots.push_back(other);
            }
        });
        chunk.all.close_row();
    }
}

/// Of all neighbours those that are near at the positions of near_reference_.
void BrownianSystem::choose_near() {
#pragma omp parallel
    share_chunks(chunks_, [&](Chunk& chunk) {
        choose_neighbours(pair_loop(near_reference_, lean_at(near_strain_)), setup_.near.last() + near_skin_, chunk.all,
                          chunk.near);
        if (setup_.springs.active()) {
            pair_up(chunk);
        }
        measure_paths(chunk, translation_.start, strain_);
    });
}

void BrownianSystem::measure_paths(Chunk& chunk, const std::vector<double>& positions, double strain) const {
    const auto longest = [&](const std::vector<double>& reference, double then) {
        return longest_squared_way(positions.data(), reference.data(), strain - then, chunk.begin, chunk.end);
    };
    chunk.list_path_squared = longest(list_reference_, list_strain_);
    chunk.near_path_squared = longest(near_reference_, near_strain_);
}

PairLoop BrownianSystem::pair_loop(const std::vector<double>& positions, double lean) const {
    return {.positions = positions.data(),
            .radii = equal_radii_ ? nullptr : radius_.data(),
            .period = {setup_.period[0], setup_.period[1], setup_.period[2]},
            .lean = lean};
}

void BrownianSystem::draw_noise(Motion& motion, const Chunk& chunk, RandomPurpose purpose) const {
    random_normals(setup_.seed, purpose, static_cast<std::uint64_t>(step_),
                   std::span(particle_).subspan(chunk.begin, chunk.end - chunk.begin), &motion.noise[4 * chunk.begin],
                   setup_.scheme.two_noises() ? &motion.second_noise[4 * chunk.begin] : nullptr);
    displace(motion.start.data(), motion.noise.data(), motion.noise_scale.data(), setup_.scheme.evaluation, chunk.begin, chunk.end,
             motion.stages[0].data());
}

/// Noise, the point where the first force is taken, the far forces and the contacts.
void BrownianSystem::begin_step(Chunk& chunk, bool refresh_far) {
    draw_noise(translation_, chunk, setup_.noise);
    if (refresh_far) {
        sum_pair_forces(pair_loop(translation_.start, lean()), setup_.far, chunk.all, far_.data());
        for (std::size_t slot = chunk.begin; setup_.weight != 0 && slot < chunk.end; ++slot) {
            far_[4 * slot + 2] -= setup_.weight * radius_[slot] * radius_[slot] * radius_[slot];
        }
    }
    if (setup_.springs.active()) {
        draw_noise(rotation_, chunk, RandomPurpose::brownian_rotation);
        refresh_springs(spring_loop(0), chunk.near_pairs.inside, chunk.springs.inside);
        refresh_springs(spring_loop(0), chunk.near_pairs.across, chunk.springs.across);
    }
}

void BrownianSystem::add_walls(const Chunk& chunk, std::size_t stage) {
    const std::vector<double>& position = translation_.stages[stage % 2];
    for (std::size_t slot = chunk.begin; slot < chunk.end; ++slot) {
        const double height = position[4 * slot + 2];
        const double below = std::max(0.0, radius_[slot] - height);
        const double above = std::max(0.0, height + radius_[slot] - setup_.ceiling);
        translation_.force[4 * slot + 2] += setup_.wall_stiffness * (below - above);
    }
}

/// All forces but those of the pairs and the far ones.
void BrownianSystem::add_other_forces(const Chunk& chunk, std::size_t stage) {
    std::copy(&far_[4 * chunk.begin], &far_[4 * chunk.begin] + 4 * (chunk.end - chunk.begin), &translation_.force[4 * chunk.begin]);
    if (setup_.ceiling > 0) {
        add_walls(chunk, stage);
    }
    if (setup_.springs.active()) {
        std::fill(&rotation_.force[4 * chunk.begin], &rotation_.force[4 * chunk.begin] + 4 * (chunk.end - chunk.begin), 0.0);
    }
    if (setup_.flow.given()) {
        add_flow(chunk);
    }
    if (setup_.springs.active()) {
        SpringLoop loop = spring_loop(stage);
        loop.force = translation_.force.data();
        loop.torque = rotation_.force.data();
        add_spring_forces(loop, chunk.springs.inside, true);
        add_spring_forces(loop, chunk.springs.across, false);
    }
}

/// Reads what all chunks left in the stage before and writes its own part of the other array.
void BrownianSystem::pass_stage(Chunk& chunk, std::size_t stage) {
    const StageWeights& weights = setup_.scheme.stages[stage];
    StageArrays arrays = translation_.arrays(stage);
    if (has_other_forces()) {
        add_other_forces(chunk, stage);
    } else {
        arrays.force = far_.data();
    }
    stage_with_pairs(pair_loop(translation_.stages[stage % 2], lean_of_stage(stage)), setup_.near, chunk.near, arrays, weights,
                     setup_.time_step);
    if (setup_.springs.active()) {
        coagula::generators::stage(rotation_.arrays(stage), chunk.begin, chunk.end, weights, setup_.time_step);
    }
}

void BrownianSystem::step() {
    double list_path = 0;
    double near_path = 0;
    for (const Chunk& chunk : chunks_) {
        list_path = std::max(list_path, chunk.list_path_squared);
        near_path = std::max(near_path, chunk.near_path_squared);
    }
    next_strain_ = setup_.flow.strain(static_cast<double>(step_ + 1) * setup_.time_step);
    // The flow brings pairs at a distance nearer by at most its strain times the distance.
    const double contact = 2 * setup_.radii.maxCoeff();
    list_path = std::sqrt(list_path) + std::abs(next_strain_ - list_strain_) * (setup_.far.last() + list_skin_ + contact) / 2;
    near_path = std::sqrt(near_path) + std::abs(next_strain_ - near_strain_) * (setup_.near.last() + near_skin_ + contact) / 2;
    // The list of all pairs must hold the far forces now and the near pairs when they are chosen.
    const double slack = std::min(0.0, setup_.far.last() - setup_.near.last() - near_skin_);
    if (list_path > (list_skin_ + slack) / 2 - reserve_) {
        make_list();
    } else if (near_path > near_skin_ / 2 - reserve_) {
        near_reference_ = translation_.start;
        near_strain_ = strain_;
        choose_near();
    }
    const bool refresh_far = step_ % setup_.far_interval == 0;
    const bool turning = setup_.springs.active();
    // More threads than chunks would only wait.
    const int threads = std::min(omp_get_max_threads(), static_cast<int>(chunks_.size()));
#pragma omp parallel num_threads(threads)
    {
        share_chunks(chunks_, [&](Chunk& chunk) { begin_step(chunk, refresh_far); });
        for (std::size_t stage = 0; stage < setup_.scheme.stages.size(); ++stage) {
            share_chunks(chunks_, [&](Chunk& chunk) {
                pass_stage(chunk, stage);
                if (stage + 1 == setup_.scheme.stages.size()) {
                    measure_paths(chunk, translation_.stages[setup_.scheme.stages.size() % 2], next_strain_);
                }
            });
        }
        if (turning) {
            share_chunks(chunks_, [&](Chunk& chunk) { advance_contacts(chunk); });
        }
    }
    // The last stage is the new position.
    std::swap(translation_.start, translation_.stages[setup_.scheme.stages.size() % 2]);
    std::swap(rotation_.start, rotation_.stages[setup_.scheme.stages.size() % 2]);
    ++step_;
    strain_ = next_strain_;
}

}  // namespace coagula::generators
