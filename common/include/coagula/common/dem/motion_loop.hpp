// SPDX-License-Identifier: GPL-3.0-or-later
// One step of central differences with local damping: the formulas, once, for single components or whole vectors in registers.
//
// A template over `Lanes` for the reasons given in bond_loop.hpp.
#pragma once

#include <cstddef>

namespace coagula::dem::detail {

/// Per-slot arrays, four numbers each (inverse mass and inertia: one), see Slots.
struct MotionArrays {
    double* position;
    double* velocity;
    const double* force;
    const double* inverse_mass;
    double* spin;
    double* turn;
    const double* moment;
    const double* inverse_inertia;
};

struct MotionStep {
    double time_step;  ///< [s]
    double damping;    ///< alpha of the local damping
    double kept;       ///< share of the velocities that is left after the step
    bool turns;        ///< whether moments act
};

/// v + dt/m (F + F_d) with the local damping F_d = -alpha |F| sign(v), where sign(0) = 0: only accelerating motion is braked.
template <class Lanes, class Real = typename Lanes::Real>
Real accelerated(const Real& velocity, const Real& force, const Real& time_over_mass, const Real& damping) {
    const Real brake = damping * Lanes::magnitude(force);
    return velocity + time_over_mass * (force - Lanes::where_positive(velocity, brake) + Lanes::where_positive(-velocity, brake));
}

/// Moves the particles in the slots [begin, end); returns their largest squared speed. The fourth components do not change, as long
/// as those of velocities, spins, forces and moments are zero. The results do not depend on the width of the lanes.
template <class Lanes>
double move_particles(const MotionArrays& slots, std::size_t begin, std::size_t end, const MotionStep& step) {
    using Real = typename Lanes::Real;
    const Real nothing{};
    const Real time_step = nothing + step.time_step;
    const Real damping = nothing + step.damping;
    const Real kept = nothing + step.kept;
    double fastest_squared = 0;
    for (std::size_t slot = begin; slot < end; ++slot) {
        const Real time_over_mass = nothing + step.time_step * slots.inverse_mass[slot];
        Real squares[4];  // NOLINT(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): see bond_loop.hpp
        for (std::size_t part = 0; part < 4; part += Lanes::width) {
            const std::size_t place = 4 * slot + part;
            const Real now =
                accelerated<Lanes>(Lanes::load(slots.velocity + place), Lanes::load(slots.force + place), time_over_mass, damping);
            Lanes::store(slots.position + place, Lanes::load(slots.position + place) + time_step * now);
            Lanes::store(slots.velocity + place, kept * now);
            squares[part] = now * now;
        }
        const double speed_squared = Lanes::sum_of_three(squares);
        fastest_squared = speed_squared > fastest_squared ? speed_squared : fastest_squared;
    }
    for (std::size_t slot = begin; step.turns && slot < end; ++slot) {
        const Real time_over_inertia = nothing + step.time_step * slots.inverse_inertia[slot];
        for (std::size_t part = 0; part < 4; part += Lanes::width) {
            const std::size_t place = 4 * slot + part;
            const Real now =
                accelerated<Lanes>(Lanes::load(slots.spin + place), Lanes::load(slots.moment + place), time_over_inertia, damping);
            Lanes::store(slots.turn + place, time_step * now);
            Lanes::store(slots.spin + place, kept * now);
        }
    }
    return fastest_squared;
}

}  // namespace coagula::dem::detail
