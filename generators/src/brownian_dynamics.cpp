// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/brownian_dynamics.hpp>

#include "brownian_sampler.hpp"
#include "brownian_schedule.hpp"
#include "brownian_system.hpp"
#include "reduced_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

constexpr double near_spacing = 5e-4;  // of the force tables, in mean radii
constexpr double far_spacing = 5e-3;
constexpr double farthest_fall = 0.1;  // in a time step, in mean radii

bool settles(const BrownianOptions& options) {
    return !std::isnan(options.sedimentation.gravity);
}

/// Between floor and ceiling; see Sedimentation.
Packing put_in_vessel(const Packing& packing, double cutoff) {
    const double largest = packing.radii.maxCoeff();
    Packing inside = packing;
    inside.cell = Cell::periodic(packing.cell.lengths() + Eigen::Vector3d(0, 0, 2 * largest + cutoff));
    for (Index particle = 0; particle < packing.size(); ++particle) {
        inside.positions.col(particle) = packing.cell.wrap(packing.positions.col(particle)) + Eigen::Vector3d(0, 0, largest);
    }
    return inside;
}

BrownianSetup make_setup(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                         const TimeStep& time_step, const ReducedUnits& units) {
    const ForceRanges ranges = choose_ranges(potential, units, options);
    const auto force = [&](double gap) { return potential.force(gap * units.length) * units.length / units.energy; };
    const auto near = [&](double gap) { return force(gap) * smooth_switch(gap, ranges.near_start, ranges.near_end); };
    const auto far = [&](double gap) {
        return force(gap) * (1 - smooth_switch(gap, ranges.near_start, ranges.near_end)) *
               smooth_switch(gap, fading_share * ranges.cutoff, ranges.cutoff);
    };
    const double weight_unit = 4 * std::numbers::pi / 3 * std::pow(units.length, 4) / units.energy;
    const Sedimentation& sedimentation = options.sedimentation;
    const double weight = settles(options) ? sedimentation.gravity * sedimentation.density_difference * weight_unit : 0;
    const double fall = std::abs(weight) * time_step.time_step / units.time;
    require(fall <= farthest_fall, "the particles would fall by " + to_text(fall) +
                                       " mean radii in a time step: take a smaller gravity or density difference");
    ShearFlow flow = options.flow;
    flow.rate *= units.time;
    flow.frequency *= units.time;
    return {.period = start.cell.edges().diagonal() / units.length,
            .radii = start.radii / units.length,
            // The first intervals of the one are elastic contact, that of the other is without force.
            .near = ForceTable(near, -2 * largest_start_overlap, potential.cut_gap() / units.length, ranges.near_end, near_spacing),
            .far = ForceTable(far, ranges.near_start - far_spacing, ranges.near_start, ranges.cutoff, far_spacing),
            .scheme = options.integrator == Integrator::euler ? euler_maruyama() : stabilised_scheme(time_step.stages),
            .time_step = time_step.time_step / units.time,
            .far_interval = time_step.far_interval,
            .seed = options.seed,
            .noise = options.noise,
            .weight = weight,
            .ceiling = settles(options) ? start.cell.edges()(2, 2) / units.length - ranges.cutoff : 0,
            .wall_stiffness = potential.contact().stiffness * units.length * units.length / units.energy,
            .springs = spring_rules(potential, options.resistance, units),
            .lean = start.cell.edges()(0, 2) / units.length,
            .flow = flow};
}

std::vector<ContactSpring> to_springs(const ContactMemories& memories) {
    std::vector<ContactSpring> springs;
    for (Index contact = 0; contact < memories.ends.cols(); ++contact) {
        springs.push_back(
            {memories.ends(0, contact), memories.ends(1, contact), memories.sliding.col(contact), memories.rolling.col(contact)});
    }
    return springs;
}

ContactMemories to_memories(const std::vector<ContactSpring>& springs) {
    const auto count = static_cast<Index>(springs.size());
    ContactMemories memories{Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic>(2, count), Eigen::Matrix3Xd(3, count),
                             Eigen::Matrix3Xd(3, count)};
    for (Index contact = 0; contact < count; ++contact) {
        const ContactSpring& spring = springs[static_cast<std::size_t>(contact)];
        memories.ends.col(contact) << spring.first, spring.second;
        memories.sliding.col(contact) = spring.sliding;
        memories.rolling.col(contact) = spring.rolling;
    }
    return memories;
}

/// One run.
class Simulation {
public:
    Simulation(const Packing& start, const PairPotential& potential, const BrownianOptions& options, const Progress& progress,
               const BrownianControl& control)
        : units_(start.radii.mean(), options),
          cutoff_(choose_ranges(potential, units_, options).cutoff * units_.length),
          start_(settles(options) ? put_in_vessel(start, cutoff_) : start),
          options_(options),
          progress_(progress),
          control_(control),
          time_step_(choose_time_step(potential, start.radii.mean(), closest_gap(start), options)),
          system_(make_setup(start_, potential, options, time_step_, units_), first_state()),
          sampler_(potential, units_, cutoff_, options.contact_tolerance),
          schedule_(options, time_step_, start.size()) {
        resume();
    }

    BrownianRun run() {
        try {
            while (schedule_.ended_by(system_.steps(), sampler_.series()).empty()) {
                system_.step();
                observe();
                watch();
            }
            if (control_.at_end && system_.steps() < schedule_.last_step()) {
                save();
            }
        } catch (const Cancelled&) {
            save();
            throw;
        }
        return describe();
    }

private:
    BrownianState first_state() const {
        if (control_.resume == nullptr) {
            return initial_state(start_.positions / units_.length);
        }
        const BrownianCheckpoint& from = *control_.resume;
        require(from.positions.cols() == start_.size(), "the checkpoint is that of another number of particles");
        const bool turning = !std::isnan(options_.resistance.tangential_stiffness);
        require(from.rotations.cols() == (turning ? start_.size() : 0),
                "the checkpoint is that of a run with other resistance of the contacts");
        return {from.step,        from.positions,  from.list_reference, from.near_reference,      from.list_strain,
                from.near_strain, from.far_forces, from.rotations,      to_springs(from.memories)};
    }

    void resume() {
        if (control_.resume == nullptr) {
            observe();
            check_start_coordination(sampler_.series().coordination.back(), options_);
            return;
        }
        require(system_.steps() <= schedule_.last_step(),
                "the checkpoint is at " + to_text(time()) + " s, after the stop time of " + to_text(options_.stop_time) + " s");
        snapshots_ = control_.resume->snapshots;
        stress_ = control_.resume->stress;
        sampler_.resume(control_.resume->series, control_.resume->contacts);
    }

    double time() const { return schedule_.time(system_.steps()); }

    Cell cell() const {
        if (!options_.flow.given()) {
            return start_.cell;
        }
        Eigen::Matrix3d edges = start_.cell.edges();
        edges(0, 2) = units_.length * system_.lean();
        return Cell::of_edges(start_.cell.origin(), edges, start_.cell.periodicity());
    }

    Packing packing() const {
        Packing packing{cell(), units_.length * system_.observed_positions(), start_.radii};
        for (Index particle = 0; particle < packing.size(); ++particle) {
            packing.positions.col(particle) = packing.cell.wrap(packing.positions.col(particle));
        }
        return packing;
    }

    /// What is due at this step.
    void observe() {
        const std::int64_t now = system_.steps();
        const bool sampled = schedule_.samples_at(now);
        if (options_.flow.given() && (sampled || now % time_step_.far_interval == 0)) {
            const Virial virial = system_.observed_virial();
            stress_.pairs += virial.pairs;
            stress_.sliding += virial.sliding;
            ++stress_.times;
        }
        if (sampled) {
            const Packing here = packing();
            sampler_.sample(here, time(), system_.observed_energy());
            if (options_.flow.given()) {
                sampler_.add_stress(here, options_.flow.strain(time()), std::exchange(stress_, {}));
            }
        }
        if (schedule_.keeps_at(now)) {
            snapshots_.push_back({time(), packing().positions});
        }
    }

    void watch() {
        constexpr std::int64_t pause = 16;
        if (system_.steps() % pause != 0 ||
            system_.steps() >= schedule_.last_step()) {  // a run to a later time has no sample at the end of this
            return;
        }
        if (system_.steps() % schedule_.sample_steps() < pause) {
            note_ = "coordination " + std::to_string(sampler_.series().coordination.back()).substr(0, 4);
        }
        progress_.update("Brownian dynamics", schedule_.share_done(system_.steps(), sampler_.series()), note_);
        const bool last = control_.at_end && schedule_.last_step() - system_.steps() <= pause;
        if (last || (control_.checkpoint_due && control_.checkpoint_due())) {
            save();
        }
    }

    void save() const {
        if (!control_.on_checkpoint) {
            return;
        }
        BrownianState state = system_.state();
        control_.on_checkpoint({state.step, std::move(state.positions), std::move(state.list_reference),
                                std::move(state.near_reference), state.list_strain, state.near_strain, std::move(state.far_forces),
                                stress_, std::move(state.rotations), to_memories(state.springs), sampler_.contacts(),
                                sampler_.series(), snapshots_});
    }

    BrownianRun describe() const {
        BrownianRun run;
        run.packing = packing();
        run.contacts = find_contacts(run.packing, options_.contact_tolerance);
        run.time = time();
        run.coordination = coordination_number(run.contacts);
        run.steps = system_.steps();
        run.ended_by = schedule_.ended_by(system_.steps(), sampler_.series());
        run.time_step = time_step_;
        run.series = sampler_.series();
        run.snapshots = snapshots_;
        return run;
    }

    ReducedUnits units_;
    double cutoff_;  ///< of the forces [m]
    Packing start_;
    const BrownianOptions& options_;
    const Progress& progress_;
    const BrownianControl& control_;
    TimeStep time_step_;
    BrownianSystem system_;
    BrownianSampler sampler_;
    BrownianSchedule schedule_;
    StressSum stress_;
    std::vector<Snapshot> snapshots_;
    std::string note_;
};

}  // namespace

BrownianRun simulate_brownian(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                              const Progress& progress, const BrownianControl& control) {
    check(start, options);
    Simulation simulation(start, potential, options, progress, control);
    return simulation.run();
}

}  // namespace coagula::generators
