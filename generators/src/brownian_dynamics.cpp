// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/brownian_dynamics.hpp>

#include <coagula/common/failures.hpp>

#include "brownian_sampler.hpp"
#include "brownian_system.hpp"
#include "plateau.hpp"
#include "reduced_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

constexpr double largest_start_overlap = 0.05;  // of the sum of the radii
constexpr double near_spacing = 5e-4;           // of the force tables, in mean radii
constexpr double far_spacing = 5e-3;
constexpr double longest_run = 1e15;              // steps
constexpr double default_sample_interval = 5e-4;  // in units of R^2/D, when no stop time is given
constexpr double default_plateau_time = 0.1;      // in units of R^2/D
constexpr int plateau_samples = 16;               // at least, over the time of the plateau
constexpr double farthest_fall = 0.1;             // in a time step, in mean radii

/// Whether all edges but the third stand upright, and that one leans along x if at all.
bool leans_along_x(const Cell& cell) {
    Eigen::Matrix3d rest = cell.edges();
    rest(0, 2) = 0;
    return rest.isDiagonal(0) && rest.diagonal().minCoeff() > 0;
}

void check(const Packing& start, const BrownianOptions& options) {
    coagula::check(start);
    require(start.cell.is_periodic(), "Brownian dynamics needs a periodic box, but that of the start is open");
    const bool plateau = options.stop_plateau != PlateauOf::nothing;
    require(!std::isnan(options.stop_time) || !std::isnan(options.stop_coordination) || plateau,
            "Brownian dynamics needs a stop time, a stop coordination or a plateau to stop at");
    if (plateau) {
        require_positive(options.plateau_change, "the change that counts as a plateau");
        if (!std::isnan(options.plateau_time)) {
            require_positive(options.plateau_time, "the time of the plateau", "s");
        }
    }
    if (!std::isnan(options.stop_time)) {
        require_non_negative(options.stop_time, "the stop time", "s");
    }
    if (!std::isnan(options.stop_coordination)) {
        require_between(options.stop_coordination, 0, 12, "the stop coordination");
    }
    if (!std::isnan(options.sample_interval)) {
        require_positive(options.sample_interval, "the sample interval", "s");
    }
    require_between(options.contact_tolerance, 0, 0.5, "the contact tolerance");
    const Sedimentation& weight = options.sedimentation;
    require(std::isnan(weight.gravity) == std::isnan(weight.density_difference),
            "gravity and a density difference need each other");
    if (!std::isnan(weight.gravity)) {
        require_positive(weight.gravity, "gravity", "m/s^2");
        require(std::isfinite(weight.density_difference), "the density difference must be a finite number");
    }
    for (const double time : options.snapshot_times) {
        require_non_negative(time, "the time of a snapshot", "s");
    }
    check(options.flow);
    const bool flows = options.flow.given();
    require(!flows || std::isnan(weight.gravity),
            "particles settle towards a floor, which a shear flow does not have: take one of them");
    require(!flows || options.snapshot_times.empty(), "a shear flow changes the box, so that snapshots cannot be kept");
    require(leans_along_x(start.cell), "the box is tilted otherwise than a shear flow along x with its gradient along z tilts it");
}

/// Smallest gap between particles [m]; a box diagonal when all are far apart.
double closest_gap(const Packing& packing) {
    const double reach = 2.2 * packing.radii.maxCoeff();
    const ContactNetwork pairs = find_pairs(packing, reach);
    double closest = packing.cell.edge_lengths().norm();
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto ends = pairs.ends.col(pair);
        const double contact = packing.radii[ends[0]] + packing.radii[ends[1]];
        const double gap = pairs.branch.col(pair).norm() - contact;
        if (gap < -largest_start_overlap * contact) {
            throw InputError("particles " + std::to_string(ends[0]) + " and " + std::to_string(ends[1]) + " overlap by " +
                             to_text(-gap) + " m at the start, which is more than " + to_text(100 * largest_start_overlap) +
                             " % of the sum of their radii");
        }
        closest = std::min(closest, gap);
    }
    return closest;
}

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
               smooth_switch(gap, 0.8 * ranges.cutoff, ranges.cutoff);
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
          sampler_(potential, units_, cutoff_, options.contact_tolerance) {
        const bool timed = !std::isnan(options.stop_time);
        last_step_ = steps_until(timed ? options.stop_time : longest_run * time_step_.time_step);
        plateau_time_ = std::isnan(options.plateau_time) ? default_plateau_time * units_.time : options.plateau_time;
        sample_steps_ = std::max<std::int64_t>(1, steps_until(sample_interval()));
        for (const double time : options.snapshot_times) {
            snapshot_steps_.push_back(steps_until(time));
        }
        std::sort(snapshot_steps_.begin(), snapshot_steps_.end());
        resume();
    }

    BrownianRun run() {
        try {
            while (ended_by().empty()) {
                system_.step();
                observe();
                watch();
            }
            if (control_.at_end && system_.steps() < last_step_) {
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

    std::int64_t steps_until(double time) const {
        return static_cast<std::int64_t>(std::ceil(std::min(time / time_step_.time_step, longest_run) - 1e-9));
    }

    void resume() {
        if (control_.resume == nullptr) {
            observe();
            const double coordination = sampler_.series().coordination.back();
            if (coordination >= options_.stop_coordination) {
                throw OutOfReach("the start has " + to_text(coordination) +
                                 " contacts per particle, but the stop coordination is " + to_text(options_.stop_coordination) +
                                 ": it must be higher than that of the start");
            }
            return;
        }
        require(system_.steps() <= last_step_,
                "the checkpoint is at " + to_text(time()) + " s, after the stop time of " + to_text(options_.stop_time) + " s");
        snapshots_ = control_.resume->snapshots;
        stress_ = control_.resume->stress;
        sampler_.resume(control_.resume->series, control_.resume->contacts);
    }

    double time() const { return static_cast<double>(system_.steps()) * time_step_.time_step; }

    double sample_interval() const {
        const bool plateau = options_.stop_plateau != PlateauOf::nothing;
        if (!std::isnan(options_.sample_interval)) {
            require(!plateau || plateau_samples * options_.sample_interval <= plateau_time_,
                    "the sample interval is " + to_text(options_.sample_interval) + " s, but a plateau of " +
                        to_text(plateau_time_) + " s needs at least " + std::to_string(plateau_samples) + " samples");
            return options_.sample_interval;
        }
        const bool timed = options_.stop_time > 0;
        const double interval = timed ? options_.stop_time / 200 : default_sample_interval * units_.time;
        return plateau ? std::min(interval, plateau_time_ / plateau_samples) : interval;
    }

    /// Empty as long as the run goes on.
    std::string ended_by() const {
        if (system_.steps() >= last_step_) {
            return "time";
        }
        const BrownianSeries& series = sampler_.series();
        if (!std::isnan(options_.stop_coordination) && series.coordination.back() >= options_.stop_coordination) {
            return "coordination";
        }
        const bool sampled = series.time.back() == time();
        const bool together = 2 * series.largest.back() >= start_.size();
        if (options_.stop_plateau != PlateauOf::nothing && sampled && together) {
            const auto& values = options_.stop_plateau == PlateauOf::coordination ? series.coordination : series.mean_gap;
            return is_plateau(series.time, values, plateau_time_, options_.plateau_change) ? "plateau" : "";
        }
        return "";
    }

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
        const bool sampled = now % sample_steps_ == 0 || now == last_step_;
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
        if (now < last_step_ && std::binary_search(snapshot_steps_.begin(), snapshot_steps_.end(), now)) {
            snapshots_.push_back({time(), packing().positions});
        }
    }

    void watch() {
        constexpr std::int64_t pause = 16;
        if (system_.steps() % pause != 0 ||
            system_.steps() >= last_step_) {  // a run to a later time has no sample at the end of this
            return;
        }
        const double coordination = sampler_.series().coordination.back();
        const double by_time = static_cast<double>(system_.steps()) / static_cast<double>(last_step_);
        const double by_contacts = std::isnan(options_.stop_coordination) ? 0.0 : coordination / options_.stop_coordination;
        if (system_.steps() % sample_steps_ < pause) {
            note_ = "coordination " + std::to_string(coordination).substr(0, 4);
        }
        progress_.update("Brownian dynamics", std::max(by_time, by_contacts), note_);
        const bool last = control_.at_end && last_step_ - system_.steps() <= pause;
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
        run.ended_by = ended_by();
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
    std::int64_t last_step_ = 0;
    std::int64_t sample_steps_ = 1;
    double plateau_time_ = unset;
    StressSum stress_;
    std::vector<std::int64_t> snapshot_steps_;
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
