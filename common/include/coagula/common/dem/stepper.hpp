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

/// dt/m (F + F_d) with the local damping F_d = -alpha |F| sign(v), where sign(0) = 0: only accelerating motion is braked.
inline double gain(double velocity, double force, double time_over_mass, double damping) {
    const double brake = damping * std::abs(force);
    return time_over_mass * (force - (velocity > 0 ? brake : 0.0) + (velocity < 0 ? brake : 0.0));
}

/// Works on single components: vectors put together from components would have to wait for their way through memory.
template <bool Turns>
void integrate(Slots& slots, Chunk& chunk, const StepOptions& options) {
    collect_all<Turns>(slots, chunk);
    const double dt = options.time_step;
    const double damping = options.damping;
    const double kept = options.stop_after_step ? 0.0 : 1.0;
    double fastest_squared = 0;
    for (std::size_t slot = at(chunk.begin); slot < at(chunk.own_end); ++slot) {
        double speed_squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
            double& velocity = slots.velocity[slot][axis];
            const double now = velocity + gain(velocity, slots.force[slot][axis], dt * slots.inverse_mass[slot], damping);
            slots.position[slot][axis] += dt * now;
            speed_squared += now * now;
            velocity = kept * now;
        }
        fastest_squared = std::max(fastest_squared, speed_squared);
        if constexpr (Turns) {
            for (int axis = 0; axis < 3; ++axis) {
                double& spin = slots.spin[slot][axis];
                const double now = spin + gain(spin, slots.moment[slot][axis], dt * slots.inverse_inertia[slot], damping);
                slots.turn[slot][axis] = dt * now;
                spin = kept * now;
            }
        }
    }
    chunk.path += dt * std::sqrt(fastest_squared);
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

/// Root of the mean squared force on a particle that is not held [N], among the first `particles` (all if negative), as left by the
/// last evaluation.
double rms_force(const ParticleSystem& system, Index particles = -1);

}  // namespace coagula::dem
