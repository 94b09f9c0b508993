// SPDX-License-Identifier: GPL-3.0-or-later
// A Brownian run whose particles another program moves. What is measured and when the run ends is as in simulate_brownian.
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>

#include <functional>

namespace coagula::generators {

/// The step of a program that gives particles a mass and integrates the Langevin equation by the method of Groenbech-Jensen and
/// Farago (Mol. Phys. 111 (2013) 983), whose positions have the right distribution at every stable step.
struct InertialStep {
    TimeStep time_step;
    double memory = unset;  ///< mass times mobility: the velocity of a particle is forgotten in this time [s]
};

/// The memory is short beside the passage of a barrier, whose rate it lowers by 2 % at most, and beside the diffusion of a
/// particle. @param closest_gap as in choose_time_step. Throws std::invalid_argument as choose_time_step does, and for particles
/// that turn, settle or flow.
InertialStep choose_inertial_step(const PairPotential& potential, double mean_radius, double closest_gap,
                                  const BrownianOptions& options);

/// The force [N] on two particles by the gap between them [m].
using ForceByGap = std::function<double(double)>;

/// The force that a run takes from the potential, for particles of mean radius: it fades to zero before the cut-off gap. Throws
/// std::invalid_argument for a cut-off gap out of range.
ForceByGap force_within_cutoff(const PairPotential& potential, const BrownianOptions& options, double mean_radius);

/// The gap beyond which there is no force [m].
double cutoff_gap(const BrownianOptions& options, double mean_radius);

/// Moves the particles by so many time steps and calls `meanwhile` now and then, which may throw to stop the run. @return where
/// they are then [m].
using MoveParticles = std::function<Eigen::Matrix3Xd(std::int64_t steps, const std::function<void()>& meanwhile)>;

/// Follows the particles of a packing in a rectangular periodic box while `move` moves them. Throws as simulate_brownian does.
BrownianRun follow_brownian(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                            const TimeStep& time_step, const MoveParticles& move, const Progress& progress = {});

/// Smallest gap between the particles of a packing [m]. Throws InputError for particles that overlap too much to start from.
double smallest_gap(const Packing& packing);

}  // namespace coagula::generators
