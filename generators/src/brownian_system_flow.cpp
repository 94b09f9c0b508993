// SPDX-License-Identifier: GPL-3.0-or-later
// A Brownian system in a liquid that flows, and its stress.
#include "brownian_system.hpp"

#include <cmath>

namespace coagula::generators {

/// Whole lengths of the box less: the same images.
double BrownianSystem::lean_at(double strain) const {
    const double lean = setup_.lean + strain * setup_.period[2];
    return lean - setup_.period[0] * std::nearbyint(lean / setup_.period[0]);
}

double BrownianSystem::lean_of_stage(std::size_t stage) const {
    return lean() + stage_times_[stage] * (next_strain_ - strain_) * setup_.period[2];
}

/// Stages are linear in the force, so that a constant velocity moves the particles by these shares of a time step, whatever acts.
void BrownianSystem::set_stage_times() {
    stage_times_ = {0.0};
    for (const StageWeights& weights : setup_.scheme.stages) {
        const double before = stage_times_.size() < 2 ? 0.0 : stage_times_[stage_times_.size() - 2];
        stage_times_.push_back(weights.force + weights.current * stage_times_.back() + weights.previous * before);
    }
}

/// The flow of the liquid as the force that would move single particles with it, and the moment that would turn them by half its
/// vorticity. In the stages like all forces: where a contact holds against the flow, its force is right however long the step.
void BrownianSystem::add_flow(const Chunk& chunk) {
    const double rate = (next_strain_ - strain_) / setup_.time_step;
    for (std::size_t slot = chunk.begin; slot < chunk.end; ++slot) {
        translation_.force[4 * slot] += rate * translation_.start[4 * slot + 2] / translation_.mobility[slot];
        if (setup_.springs.active()) {
            rotation_.force[4 * slot + 1] += 0.5 * rate / rotation_.mobility[slot];
        }
    }
}

/// Each pair stands in the rows of both its particles, whose halves are added.
Eigen::Matrix3d BrownianSystem::pair_virial(const Chunk& chunk, const std::vector<double>& positions) const {
    const Eigen::Vector3d& period = setup_.period;
    const double lean_now = lean();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t entry = 0; entry < chunk.all.slots.size(); ++entry) {
        const auto first = static_cast<std::size_t>(chunk.all.owners[entry / NeighbourRows::width]);
        const auto second = static_cast<std::size_t>(chunk.all.slots[entry]);
        if (first == second) {  // fills up the row
            continue;
        }
        Eigen::Vector3d way = Eigen::Vector3d::Map(&positions[4 * second]) - Eigen::Vector3d::Map(&positions[4 * first]);
        const double layers = std::nearbyint(way[2] / period[2]);
        way -= layers * Eigen::Vector3d(lean_now, 0, period[2]);
        way[1] -= period[1] * std::nearbyint(way[1] / period[1]);
        way[0] -= period[0] * std::nearbyint(way[0] / period[0]);
        const double distance = way.norm();
        const double radii = radius_[first] + radius_[second];
        const double gap = distance - radii;
        if (gap < setup_.far.last()) {
            const double force = 2 * radius_[first] * radius_[second] / radii * (setup_.near.force(gap) + setup_.far.force(gap));
            sum -= 0.5 * force / distance * way * way.transpose();
        }
    }
    return sum;
}

Virial BrownianSystem::observed_virial() const {
    Virial virial;
    const std::vector<double> positions = translation_.observed(setup_, step_, RandomPurpose::brownian_observation, particle_);
    std::vector<Eigen::Matrix3d> of_chunk(chunks_.size());
    const auto count = static_cast<std::ptrdiff_t>(chunks_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t number = 0; number < count; ++number) {
        of_chunk[static_cast<std::size_t>(number)] = pair_virial(chunks_[static_cast<std::size_t>(number)], positions);
    }
    for (const Eigen::Matrix3d& part : of_chunk) {  // in this order for any number of threads
        virial.pairs += part;
    }
    virial.sliding = observed_sliding_virial(positions);
    return virial;
}

}  // namespace coagula::generators
