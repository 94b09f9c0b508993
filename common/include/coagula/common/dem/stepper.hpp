// Explicit integration of the equations of motion (central differences, that is leap-frog) with local damping.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/dem/forces.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::dem {

/// How one step is made.
struct StepOptions {
    double time_step = unset;         ///< [s], > 0
    double damping = 0;               ///< alpha of the local non-viscous damping, 0 <= alpha < 1 (eq. 3 of Schenker et al. 2012)
    bool stop_after_step = false;     ///< zero all velocities after the step: the paper's relaxation
};

namespace detail {

/// Force with local damping, per component: F_d = -alpha |F| sign(v), where sign(0) = 0, so that only accelerating motion is braked.
inline double damped(double force, double velocity, double damping) {
    const double brake = std::copysign(damping * std::abs(force), velocity);
    return velocity == 0 ? force : force - brake;
}

inline Quad damped(const Quad& force, const Quad& velocity, double damping) {
    return {damped(force[0], velocity[0], damping), damped(force[1], velocity[1], damping), damped(force[2], velocity[2], damping),
            0.0};
}

/// Moves an own slot and keeps account of how far it has come.
inline void move(Slots& slots, std::size_t slot, const Quad& displacement, Chunk& chunk) {
    slots.position[slot] += displacement;
    const double squared = (slots.position[slot] - slots.reference[slot]).template head<3>().squaredNorm();
    chunk.displacement_squared = std::max(chunk.displacement_squared, squared);
}

template <bool Turns>
void integrate(Slots& slots, Chunk& chunk, const StepOptions& options) {
    const double dt = options.time_step;
    collect_all<Turns>(slots, chunk);
    for (std::size_t slot = at(chunk.begin); slot < at(chunk.own_end); ++slot) {
        Quad& velocity = slots.velocity[slot];
        velocity += (dt * slots.inverse_mass[slot]) * damped(slots.force[slot], velocity, options.damping);
        move(slots, slot, dt * velocity, chunk);
        if constexpr (Turns) {
            Quad& spin = slots.spin[slot];
            spin += (dt * slots.inverse_inertia[slot]) * damped(slots.moment[slot], spin, options.damping);
            slots.turn[slot] = dt * spin;
        }
        if (options.stop_after_step) {
            slots.velocity[slot].setZero();
            slots.spin[slot].setZero();
        }
    }
}

}  // namespace detail

/// One step: forces at x(t), then v(t + dt/2) = v(t - dt/2) + dt F/m and x(t + dt) = x(t) + dt v(t + dt/2); likewise for rotations
/// where the bond law turns particles. Forces left in the system are those at x(t).
/// Stable for dt < 2 / (highest angular frequency). Throws std::runtime_error when positions run away.
template <class Laws>
void step(ParticleSystem& system, const Laws& laws, const StepOptions& options) {
    system.refresh();
    Slots& slots = system.slots();
    detail::for_each_chunk(system, [&](Chunk& chunk) { detail::evaluate(slots, chunk, laws); });
    detail::for_each_chunk(system, [&](Chunk& chunk) { detail::integrate<Laws::turns>(slots, chunk, options); });
}

/// Throws std::invalid_argument unless the time step is positive and 0 <= damping < 1.
void check(const StepOptions& options);

/// Root of the mean squared force on a particle [N], over the first `particles` (all if negative), as left by the last evaluation.
double rms_force(const ParticleSystem& system, Index particles = -1);

}  // namespace coagula::dem
