// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/engine_run.hpp>

#include "brownian_sampler.hpp"
#include "brownian_schedule.hpp"
#include "force_table.hpp"
#include "reduced_units.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

// In units of R^2/D.
constexpr double longest_memory = 2e-6;  // free paths of sqrt(memory) are then a seven-hundredth of a radius
// Inertia lowers the rate over a barrier of frequency lambda by lambda times the memory (Kramers 1940). The accuracy bound of the
// time step is 1/28 of 1/lambda.
constexpr double memory_share = 0.5;
constexpr double stability = 2;     // of the leapfrog in units of sqrt(mass/stiffness)
constexpr double step_share = 0.5;  // of that: forces are not linear

void check_engine(const BrownianOptions& options) {
    require(std::isnan(options.resistance.tangential_stiffness) && std::isnan(options.resistance.rolling_stiffness) &&
                std::isnan(options.sedimentation.gravity) && !options.flow.given(),
            "particles that turn, settle or flow are moved by the integrator of coagula only");
}

Eigen::Matrix3Xd wrapped(const Cell& cell, Eigen::Matrix3Xd positions) {
    for (Index particle = 0; particle < positions.cols(); ++particle) {
        positions.col(particle) = cell.wrap(positions.col(particle));
    }
    return positions;
}

}  // namespace

InertialStep choose_inertial_step(const PairPotential& potential, double mean_radius, double closest_gap,
                                  const BrownianOptions& options) {
    check_engine(options);
    BrownianOptions overdamped = options;
    overdamped.integrator = Integrator::euler;
    overdamped.time_step = unset;
    TimeStep step = choose_time_step(potential, mean_radius, closest_gap, overdamped);
    const double rate = 2 / step.stability_bound;  // at least that of the stiffest motion without inertia
    InertialStep inertial;
    inertial.memory = std::min(memory_share * step.accuracy_bound, longest_memory * step.diffusion_time);
    const double period = std::sqrt(inertial.memory / rate);
    step.stability_bound = stability * period;
    step.reason = "the stiffness of the contacts and the mass of the particles";
    step.time_step = step_share * step.stability_bound;
    if (!std::isnan(options.time_step)) {
        step.time_step = require_positive(options.time_step, "the time step", "s");
        step.reason = "the option";
        require(step.time_step <= step.stability_bound, "the time step is " + to_text(step.time_step) +
                                                            " s, but the integrator is stable up to " +
                                                            to_text(step.stability_bound) + " s only");
    }
    step.stages = 1;
    step.far_interval = 1;
    inertial.time_step = step;
    return inertial;
}

double cutoff_gap(const BrownianOptions& options, double mean_radius) {
    return std::isnan(options.cutoff_gap) ? mean_radius : options.cutoff_gap;
}

ForceByGap force_within_cutoff(const PairPotential& potential, const BrownianOptions& options, double mean_radius) {
    const ReducedUnits units(mean_radius, options);
    const ForceRanges ranges = choose_ranges(potential, units, options);
    return [potential, ranges, length = units.length](double gap) {
        const double reduced = gap / length;
        const double near = smooth_switch(reduced, ranges.near_start, ranges.near_end);
        const double far = smooth_switch(reduced, fading_share * ranges.cutoff, ranges.cutoff);
        return reduced < ranges.cutoff ? potential.force(gap) * (near + (1 - near) * far) : 0.0;
    };
}

BrownianRun follow_brownian(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                            const TimeStep& time_step, const MoveParticles& move, const Progress& progress) {
    check(start, options);
    check_engine(options);
    const ReducedUnits units(mean_radius(start), options);
    BrownianSampler sampler(potential, units, cutoff_gap(options, units.length), options.contact_tolerance);
    const BrownianSchedule schedule(options, time_step, start.size());
    BrownianRun run;
    run.time_step = time_step;
    run.packing = {start.cell, wrapped(start.cell, start.positions), start.radii};
    const auto observe = [&] {
        if (schedule.samples_at(run.steps)) {
            sampler.sample(run.packing, schedule.time(run.steps), {});
        }
        if (schedule.keeps_at(run.steps)) {
            run.snapshots.push_back({schedule.time(run.steps), run.packing.positions});
        }
    };
    observe();
    check_start_coordination(sampler.series().coordination.back(), options);
    while ((run.ended_by = schedule.ended_by(run.steps, sampler.series())).empty()) {
        const std::int64_t due = schedule.next_due(run.steps);
        const double done = schedule.share_done(run.steps, sampler.series());
        const std::string note = "coordination " + std::to_string(sampler.series().coordination.back()).substr(0, 4);
        const auto tell = [&] { progress.update("Brownian dynamics", done, note); };
        run.packing.positions = wrapped(start.cell, move(due - run.steps, tell));
        run.steps = due;
        observe();
    }
    run.contacts = find_contacts(run.packing, options.contact_tolerance);
    run.time = schedule.time(run.steps);
    run.coordination = coordination_number(run.contacts);
    run.series = sampler.series();
    return run;
}

double smallest_gap(const Packing& packing) {
    return closest_gap(packing);
}

}  // namespace coagula::generators
