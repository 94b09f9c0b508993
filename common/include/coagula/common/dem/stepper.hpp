// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit integration of the equations of motion (central differences, that is leap-frog) with local damping.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/dem/forces.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::dem {

/// How one step is made.
struct StepOptions {
    double time_step = unset;      ///< [s], > 0
    double damping = 0;            ///< alpha of the local non-viscous damping, 0 <= alpha < 1 (eq. 3 of Schenker et al. 2012)
    bool stop_after_step = false;  ///< zero all velocities after the step: the paper's relaxation
};

namespace detail {

inline MotionArrays motion_arrays_of(Slots& slots) {
    return {slots.position.data()->data(), slots.velocity.data()->data(), slots.force.data()->data(),
            slots.inverse_mass.data(),     slots.spin.data()->data(),     slots.turn.data()->data(),
            slots.moment.data()->data(),   slots.inverse_inertia.data()};
}

template <bool Turns>
void integrate(Slots& slots, Chunk& chunk, const StepOptions& options) {
    collect_all<Turns>(slots, chunk);
    const MotionStep step{options.time_step, options.damping, options.stop_after_step ? 0.0 : 1.0, Turns};
    const double fastest_squared =
        fastest_kernels().move_particles(motion_arrays_of(slots), at(chunk.begin), at(chunk.own_end), step);
    chunk.path += options.time_step * std::sqrt(fastest_squared);
}

}  // namespace detail

/// One step: forces at x(t), then v(t + dt/2) = v(t - dt/2) + dt F/m and x(t + dt) = x(t) + dt v(t + dt/2); likewise for rotations
/// where the bond law turns particles. Forces left in the system are those at x(t).
/// Stable for dt < 2 / (highest angular frequency). Throws std::runtime_error when positions run away.
template <class Laws>
void step(ParticleSystem& system, const Laws& laws, const StepOptions& options) {
    system.refresh();
    Slots& slots = system.slots();
    detail::for_each_chunk(system, [&](Chunk& chunk) { detail::evaluate(slots, chunk, laws, system.near_skin()); });
    // Backwards, to begin with what the caches still hold.
    detail::for_each_chunk(
        system, [&](Chunk& chunk) { detail::integrate<Laws::turns>(slots, chunk, options); }, true);
}

/// Throws std::invalid_argument unless the time step is positive and 0 <= damping < 1.
void check(const StepOptions& options);

/// Root of the mean squared force on a particle that is not held [N], among the first `particles` (all if negative), as left by the
/// last evaluation.
double rms_force(const ParticleSystem& system, Index particles = -1);

}  // namespace coagula::dem
