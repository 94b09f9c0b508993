// SPDX-License-Identifier: GPL-3.0-or-later
// Fast inertial relaxation engine (FIRE): Bitzek, Koskinen, Gaehler, Moseler, Gumbsch, Phys. Rev. Lett. 97 (2006) 170201.
#pragma once

#include <coagula/common/dem/forces.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace coagula::dem {

/// Minimises the energy of contacts and bonds on the forces of the stepper, one iteration at a time.
///
/// Velocities are steered along the force while the system goes downhill and set to zero when it goes uphill; the time step adapts.
/// Rotations take part where the bond law turns particles. Norms are weighted with mass and inertia.
template <class Laws>
class Fire {
public:
    /// @param time_step first and @param longest_time_step longest step; stable well below 2 / (highest angular frequency) [s].
    Fire(ParticleSystem& system, const Laws& laws, double time_step, double longest_time_step)
        : system_(system),
          laws_(laws),
          time_step_(time_step),
          longest_time_step_(longest_time_step),
          sums_(system.chunks().size()) {
        for (std::size_t slot = 0; slot < system.slots().velocity.size(); ++slot) {
            system.slots().velocity[slot].setZero();
            system.slots().spin[slot].setZero();
        }
    }

    /// One iteration; returns the rms force on a particle [N] at the positions before it (0 once nothing acts any more).
    double iterate() {
        system_.refresh();
        Slots& slots = system_.slots();
        detail::for_each_chunk(system_, [&](Chunk& chunk) { detail::evaluate(slots, chunk, laws_, system_.near_skin()); });
        detail::for_each_chunk(system_, [&](Chunk& chunk) { sums_[number_of(chunk)] = collect_sums(slots, chunk); });
        Sums total;
        for (const Sums& part : sums_) {
            total += part;
        }
        const Blend blend = adapt(total);
        detail::for_each_chunk(system_, [&](Chunk& chunk) { move_chunk(slots, chunk, blend); });
        return std::sqrt(total.force_squared / static_cast<double>(system_.size()));
    }

private:
    struct Sums {
        double power = 0;                 // sum of F.v
        double acceleration_squared = 0;  // sum of F^2 / m
        double velocity_squared = 0;      // sum of m v^2
        double force_squared = 0;         // sum of F^2, forces only

        void operator+=(const Sums& other) {
            power += other.power;
            acceleration_squared += other.acceleration_squared;
            velocity_squared += other.velocity_squared;
            force_squared += other.force_squared;
        }
        void add(const Quad& force, const Quad& velocity, double inverse_mass) {
            power += force.dot(velocity);
            acceleration_squared += force.squaredNorm() * inverse_mass;
            velocity_squared += velocity.squaredNorm() / inverse_mass;
        }
    };

    /// New velocity = keep v + push F/m.
    struct Blend {
        double keep;
        double push;
    };

    std::size_t number_of(const Chunk& chunk) const { return static_cast<std::size_t>(&chunk - system_.chunks().data()); }

    static Sums collect_sums(Slots& slots, const Chunk& chunk) {
        Sums sums;
        detail::collect_all<Laws::turns>(slots, chunk);
        for (std::size_t slot = detail::at(chunk.begin); slot < detail::at(chunk.own_end); ++slot) {
            if (slots.inverse_mass[slot] == 0) {
                continue;  // held
            }
            sums.add(slots.force[slot], slots.velocity[slot], slots.inverse_mass[slot]);
            sums.force_squared += slots.force[slot].squaredNorm();
            if constexpr (Laws::turns) {
                sums.add(slots.moment[slot], slots.spin[slot], slots.inverse_inertia[slot]);
            }
        }
        return sums;
    }

    /// The rule of the paper: N_min = 5, f_inc = 1.1, f_dec = 0.5, alpha_start = 0.1, f_alpha = 0.99.
    Blend adapt(const Sums& total) {
        if (total.power <= 0) {
            downhill_ = 0;
            mixing_ = 0.1;
            if (started_) {
                time_step_ *= 0.5;
            }
            started_ = true;
            return {0.0, time_step_};
        }
        const double aligned = mixing_ * std::sqrt(total.velocity_squared / total.acceleration_squared);
        const double keep = 1 - mixing_;
        if (++downhill_ > 5) {
            time_step_ = std::min(1.1 * time_step_, longest_time_step_);
            mixing_ *= 0.99;
        }
        return {keep, aligned + time_step_};
    }

    void move_chunk(Slots& slots, Chunk& chunk, const Blend& blend) const {
        double fastest_squared = 0;
        for (std::size_t slot = detail::at(chunk.begin); slot < detail::at(chunk.own_end); ++slot) {
            Quad& velocity = slots.velocity[slot];
            velocity = blend.keep * velocity + (blend.push * slots.inverse_mass[slot]) * slots.force[slot];
            slots.position[slot] += time_step_ * velocity;
            fastest_squared = std::max(fastest_squared, velocity.squaredNorm());
            if constexpr (Laws::turns) {
                Quad& spin = slots.spin[slot];
                spin = blend.keep * spin + (blend.push * slots.inverse_inertia[slot]) * slots.moment[slot];
                slots.turn[slot] = time_step_ * spin;
            }
        }
        chunk.path += time_step_ * std::sqrt(fastest_squared);
    }

    ParticleSystem& system_;
    Laws laws_;
    double time_step_;
    double longest_time_step_;
    double mixing_ = 0.1;
    int downhill_ = 0;
    bool started_ = false;
    std::vector<Sums> sums_;
};

}  // namespace coagula::dem
