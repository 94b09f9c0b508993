// SPDX-License-Identifier: GPL-3.0-or-later
// One orientation of the rheometer: rest, oscillate, compare with rest. A template over the interactions, so that simple bonds run
// at full speed.
#pragma once

#include "oscillation.hpp"
#include "plates.hpp"
#include "stress_probe.hpp"

#include <coagula/common/dem/general_forces.hpp>
#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::mechanics {

/// Linear springs and strengths, the contact of the paper: the fast way.
struct SimpleInteractions : dem::Interactions<RepulsiveSpring, BondedContact> {
    GeneralContact law;      ///< that these stand for
    double longest_stretch;  ///< a bond breaks beyond [m]
    double longest_shear;    ///< [m]
};

/// What differs between the interactions.
inline std::vector<dem::BrokenBond> break_overloaded(dem::ParticleSystem& system, const SimpleInteractions& laws) {
    const auto loads = system.largest_bond_loads();
    const double shear_squared = laws.longest_shear * laws.longest_shear;
    if (loads.stretch <= laws.longest_stretch && loads.shear_squared <= shear_squared) {
        return {};
    }
    std::vector<dem::BrokenBond> broken;
    for (const dem::Bond& bond : system.remove_bonds([&](const dem::Bond& held) {
             return held.memory.branch.norm() - held.memory.rest_length > laws.longest_stretch ||
                    held.memory.shear.squaredNorm() > shear_squared;
         })) {
        ContactMemory memory = bond.memory;
        memory.shear_stiffness = laws.law.normal(0, 1, true).shear_stiffness;
        // Of linear springs nothing depends on the radii.
        broken.push_back(
            {bond.first, bond.second, memory.branch, laws.law.energy(memory, 1, 1), laws.law.load(memory, 1, 1).limit});
    }
    return broken;
}
inline std::vector<dem::BrokenBond> break_overloaded(dem::ParticleSystem& system, const dem::GeneralInteractions& laws) {
    return dem::break_bonds(system, laws.law);
}
inline void become_older(dem::ParticleSystem& /*system*/, SimpleInteractions& /*laws*/, double /*time*/) {}
inline void become_older(dem::ParticleSystem& system, dem::GeneralInteractions& laws, double time) {
    const ContactModel& model = laws.law.model();
    if (!std::isnan(model.ageing_rate)) {
        dem::set_age(system, laws.law, 1 + model.ageing_rate * std::log1p(time / model.ageing_time));
    }
}
inline void set_shear_rate(SimpleInteractions& /*laws*/, double /*rate*/) {}
inline void set_shear_rate(dem::GeneralInteractions& laws, double rate) {
    laws.solvent.shear_rate = rate;
}
/// The interactions without losses that depend on the rate.
inline SimpleInteractions at_rest(const SimpleInteractions& laws) {
    return laws;
}
inline dem::GeneralInteractions at_rest(const dem::GeneralInteractions& laws) {
    return dem::GeneralInteractions{laws.law, 0};
}

template <class Laws>
class ShearRun {
public:
    /// @param force_scale normal contact stiffness x mean radius [N].
    ShearRun(const MountedSample& mounted, const RheometerOptions& options, const ShearOrientation& orientation,
             dem::ParticleSystem system, const Laws& laws, double time_step, double force_scale, const Progress& progress)
        : mounted_(mounted),
          options_(options),
          system_(std::move(system)),
          laws_(laws),
          time_step_(time_step),
          force_scale_(force_scale),
          progress_(progress),
          probe_(mounted, options, orientation) {
        run_.orientation = orientation;
        run_.sphere_stress.resize(0, probe_.spheres());
        name_ = std::string("shear ") + "xyz"[orientation.normal] + "xyz"[orientation.direction];
    }

    /// Goes on from a checkpoint.
    void resume(const RheometerCheckpoint& checkpoint) {
        run_ = checkpoint.current;
        hold_plates();
        system_.restore(checkpoint.state);
    }

    /// Steps with velocities set to zero until the unbalanced force is constant.
    void rest() {
        hold_plates();
        const dem::StepOptions stepping{time_step_, 0.0, true};
        const auto resting = at_rest(laws_);
        double before = 0;
        while (run_.rest_steps < options_.most_rest_steps) {
            for (int count = 0; count < rest_block; ++count) {
                dem::step(system_, resting, stepping);
            }
            run_.rest_steps += rest_block;
            const double now = dem::rms_force(system_) / force_scale_;
            run_.rest_force = now;
            progress_.update("relaxation", 0.0, "rms force " + to_text(now));
            if (now < options_.rest_tolerance || std::abs(now - before) < options_.rest_change * before) {
                break;
            }
            before = now;
        }
    }

    void oscillate(const std::function<void(const dem::ParticleState&, const RheometerRun&)>& checkpoint) {
        for (auto number = static_cast<int>(run_.oscillations.size()); number < options_.oscillations; ++number) {
            become_older(system_, laws_, number / options_.frequency);
            const double amplitude = options_.amplitude * part_of_amplitude(number);
            const std::size_t first = run_.stress.size();
            const std::size_t broken = run_.broken.size();
            move(amplitude, 0, options_.steps_per_oscillation, number);
            run_.oscillations.push_back(evaluate_oscillation({run_.stress.data() + first, run_.stress.size() - first}, amplitude));
            run_.oscillations.back().broken_bonds = static_cast<Index>(run_.broken.size() - broken);
            system_.restore(system_.state());  // as a run does that goes on from here
            checkpoint(system_.state(), run_);
        }
    }

    /// A quarter oscillation more, to the peak; then the network comes to rest there.
    void compare_with_rest() {
        const double offset = run_.oscillations.back().offset;
        const RheometerRun kept = run_;
        move(options_.amplitude, 0, options_.steps_per_oscillation / 4, options_.oscillations);
        run_ = kept;
        stop_plate();
        const auto resting = at_rest(laws_);
        dem::compute_forces(system_, laws_);
        const StressSample moving = probe_.measure(system_, laws_);
        run_.unbalanced_ratio = dem::rms_force(system_) / std::max(moving.mean_contact_force, 1e-300);
        const double small = 1e-5 * moving.mean_contact_force;
        dem::Fire fire(system_, resting, time_step_, 1.6 * time_step_);
        double force = 1;
        int iteration = 0;
        for (; iteration < most_fire_iterations && force > small; ++iteration) {
            force = fire.iterate();
            if (iteration % rest_block == 0) {
                progress_.update(name_ + ", rest at the peak", 1.0);
            }
        }
        dem::compute_forces(system_, resting);
        const double still = probe_.measure(system_, resting).whole - offset;
        if (iteration < most_fire_iterations && still != 0) {
            run_.rest_modulus = still / options_.amplitude;
            run_.rate_error = (moving.whole - offset) / still - 1;
        }
    }

    RheometerRun result() const {
        RheometerRun run = run_;
        const double amplitude = run.oscillations.back().amplitude;
        if (mounted_.has_plates()) {
            const auto last = static_cast<std::size_t>(options_.samples_per_oscillation);
            run.plate_storage = evaluate_oscillation({run.plate_stress.data() + (run.plate_stress.size() - last), last}, amplitude)
                                    .fundamental_storage;
            run.sphere_storage.resize(probe_.spheres());
            for (Index sphere = 0; sphere < probe_.spheres(); ++sphere) {
                const Eigen::VectorXd stress = run.sphere_stress.col(sphere).tail(options_.samples_per_oscillation);
                run.sphere_storage[sphere] = evaluate_oscillation({stress.data(), last}, amplitude).fundamental_storage;
            }
        }
        return run;
    }

private:
    static constexpr int rest_block = 100;
    static constexpr int most_fire_iterations = 20000;

    void hold_plates() {
        system_.hold(mounted_.lower);
        system_.hold(mounted_.upper);
    }
    void stop_plate() {
        Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, system_.size());
        system_.set_velocities(none);
        system_.set_spins(none);
    }

    double part_of_amplitude(int oscillation) const {
        if (!options_.course.empty()) {
            return options_.course[static_cast<std::size_t>(oscillation)].part;
        }
        return options_.growing ? (oscillation + 1.0) / options_.oscillations : 1.0;
    }
    double strain_at(double amplitude, int step) const {
        return amplitude * std::sin(2 * std::numbers::pi * step / options_.steps_per_oscillation);
    }

    /// Steps `from` to `to` of an oscillation.
    void move(double amplitude, int from, int to, int oscillation) {
        const dem::StepOptions stepping{time_step_, options_.damping, false};
        const int interval = options_.steps_per_oscillation / options_.samples_per_oscillation;
        const int normal = run_.orientation.normal;
        const int direction = run_.orientation.direction;
        const auto place = static_cast<std::size_t>(oscillation);
        const bool breaks = place >= options_.course.size() || options_.course[place].breaks;
        for (int step = from; step < to; ++step) {
            const double strain = strain_at(amplitude, step);
            const double increment = strain_at(amplitude, step + 1) - strain;
            if (mounted_.has_plates()) {
                Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
                velocity[direction] = increment * mounted_.height / time_step_;
                system_.set_velocity(mounted_.upper, velocity);
            }
            set_shear_rate(laws_, increment / time_step_);
            dem::step(system_, laws_, stepping);
            if (breaks) {
                note_broken(strain, oscillation);
            }
            if (step % interval == 0) {
                note_stress(strain);
                progress_.update(name_, (oscillation + static_cast<double>(step) / to) / options_.oscillations);
            }
            if (!mounted_.has_plates()) {
                system_.shear(direction, normal, increment);
            }
        }
    }

    void note_broken(double strain, int oscillation) {
        for (const dem::BrokenBond& bond : break_overloaded(system_, laws_)) {
            run_.broken.push_back({mounted_.origin[static_cast<std::size_t>(bond.first)],
                                   mounted_.origin[static_cast<std::size_t>(bond.second)], strain, oscillation, bond.cause});
        }
    }

    void note_stress(double strain) {
        const StressSample sample = probe_.measure(system_, laws_);
        require_finite(sample.whole);
        run_.strain.push_back(strain);
        run_.stress.push_back(sample.whole);
        if (mounted_.has_plates()) {
            run_.plate_stress.push_back(sample.plate);
            run_.sphere_stress.conservativeResize(run_.sphere_stress.rows() + 1, Eigen::NoChange);
            run_.sphere_stress.bottomRows<1>() = sample.spheres.transpose();
        }
    }

    static void require_finite(double stress) {
        if (!std::isfinite(stress)) {
            throw std::runtime_error(
                "the explicit run has become unstable: its stress is not finite; more steps per oscillation "
                "make the time step smaller");
        }
    }

    const MountedSample& mounted_;
    const RheometerOptions& options_;
    dem::ParticleSystem system_;
    Laws laws_;
    double time_step_;
    double force_scale_;
    const Progress& progress_;
    StressProbe probe_;
    RheometerRun run_;
    std::string name_;
};

}  // namespace coagula::mechanics
