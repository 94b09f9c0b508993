#include <coagula/generators/brownian_dynamics.hpp>

#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/random.hpp>

#include "brownian_sampler.hpp"
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

constexpr double largest_start_overlap = 0.05;  // of the sum of the radii
constexpr double near_spacing = 5e-4;           // of the force tables, in mean radii
constexpr double far_spacing = 5e-3;
constexpr double longest_run = 1e15;              // steps
constexpr double default_sample_interval = 5e-4;  // in units of R^2/D, when no stop time is given

void check(const Packing& start, const BrownianOptions& options) {
    coagula::check(start);
    require(start.cell.is_periodic(), "Brownian dynamics needs a periodic box, but that of the start is open");
    require(!std::isnan(options.stop_time) || !std::isnan(options.stop_coordination),
            "Brownian dynamics needs a stop time or a stop coordination");
    if (!std::isnan(options.stop_time)) {
        require_non_negative(options.stop_time, "the stop time", "s");
    }
    if (!std::isnan(options.stop_coordination)) {
        require_between(options.stop_coordination, 0, 12, "the stop coordination");
    }
    if (!std::isnan(options.sample_interval)) {
        require_positive(options.sample_interval, "the sample interval", "s");
    }
    require_between(options.contact_tolerance, 0, 0.1, "the contact tolerance");
    for (const double time : options.snapshot_times) {
        require_non_negative(time, "the time of a snapshot", "s");
    }
}

/// Smallest gap between particles [m]; a box diagonal when all are far apart.
double closest_gap(const Packing& packing) {
    const double reach = 2.2 * packing.radii.maxCoeff();
    const ContactNetwork pairs = find_pairs(packing, reach);
    double closest = packing.cell.lengths().norm();
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

BrownianSetup make_setup(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                         const TimeStep& time_step, const ReducedUnits& units) {
    const ForceRanges ranges = choose_ranges(potential, units, options);
    const auto force = [&](double gap) { return potential.force(gap * units.length) * units.length / units.energy; };
    const auto near = [&](double gap) { return force(gap) * smooth_switch(gap, ranges.near_start, ranges.near_end); };
    const auto far = [&](double gap) {
        return force(gap) * (1 - smooth_switch(gap, ranges.near_start, ranges.near_end)) *
               smooth_switch(gap, 0.8 * ranges.cutoff, ranges.cutoff);
    };
    return {.period = start.cell.lengths() / units.length,
            .radii = start.radii / units.length,
            // The first interval of the one is elastic contact, that of the other without force.
            .near = ForceTable(near, potential.cut_gap() / units.length - near_spacing, ranges.near_end, near_spacing),
            .far = ForceTable(far, ranges.near_start - far_spacing, ranges.cutoff, far_spacing),
            .scheme = options.integrator == Integrator::euler ? euler_maruyama() : stabilised_scheme(time_step.stages),
            .time_step = time_step.time_step / units.time,
            .far_interval = time_step.far_interval,
            .seed = options.seed,
            .noise = options.noise};
}

/// One run.
class Simulation {
public:
    Simulation(const Packing& start, const PairPotential& potential, const BrownianOptions& options, const Progress& progress,
               const BrownianControl& control)
        : start_(start),
          options_(options),
          progress_(progress),
          control_(control),
          units_(start.radii.mean(), options),
          time_step_(choose_time_step(potential, start.radii.mean(), closest_gap(start), options)),
          system_(make_setup(start, potential, options, time_step_, units_), first_state()),
          sampler_(potential, units_, choose_ranges(potential, units_, options).cutoff * units_.length, options.contact_tolerance) {
        const bool timed = !std::isnan(options.stop_time);
        last_step_ = steps_until(timed ? options.stop_time : longest_run * time_step_.time_step);
        const double by_default = timed && options.stop_time > 0 ? options.stop_time / 200 : default_sample_interval * units_.time;
        const double interval = std::isnan(options.sample_interval) ? by_default : options.sample_interval;
        sample_steps_ = std::max<std::int64_t>(1, steps_until(interval));
        for (const double time : options.snapshot_times) {
            snapshot_steps_.push_back(steps_until(time));
        }
        std::sort(snapshot_steps_.begin(), snapshot_steps_.end());
        resume();
    }

    BrownianRun run() {
        try {
            while (!at_end()) {
                system_.step();
                observe();
                watch();
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
        return {from.step, from.positions, from.list_reference, from.near_reference, from.far_forces};
    }

    std::int64_t steps_until(double time) const {
        return static_cast<std::int64_t>(std::ceil(std::min(time / time_step_.time_step, longest_run) - 1e-9));
    }

    void resume() {
        if (control_.resume == nullptr) {
            observe();
            return;
        }
        snapshots_ = control_.resume->snapshots;
        sampler_.resume(control_.resume->series, control_.resume->contacts);
    }

    double time() const { return static_cast<double>(system_.steps()) * time_step_.time_step; }

    bool at_end() const {
        const std::vector<double>& coordination = sampler_.series().coordination;
        return system_.steps() >= last_step_ ||
               (!std::isnan(options_.stop_coordination) && coordination.back() >= options_.stop_coordination);
    }

    Packing packing() const {
        Packing packing{start_.cell, units_.length * system_.observed_positions(), start_.radii};
        for (Index particle = 0; particle < packing.size(); ++particle) {
            packing.positions.col(particle) = packing.cell.wrap(packing.positions.col(particle));
        }
        return packing;
    }

    /// What is due at this step.
    void observe() {
        const std::int64_t now = system_.steps();
        if (now % sample_steps_ == 0 || now == last_step_) {
            sampler_.sample(packing(), time());
        }
        if (now < last_step_ && std::binary_search(snapshot_steps_.begin(), snapshot_steps_.end(), now)) {
            snapshots_.push_back({time(), packing().positions});
        }
    }

    void watch() {
        constexpr std::int64_t pause = 16;
        if (system_.steps() % pause != 0) {
            return;
        }
        const double coordination = sampler_.series().coordination.back();
        const double by_time = static_cast<double>(system_.steps()) / static_cast<double>(last_step_);
        const double by_contacts = std::isnan(options_.stop_coordination) ? 0.0 : coordination / options_.stop_coordination;
        if (system_.steps() % sample_steps_ < pause) {
            note_ = "coordination " + std::to_string(coordination).substr(0, 4);
        }
        progress_.update("Brownian dynamics", std::max(by_time, by_contacts), note_);
        if (control_.checkpoint_due && control_.checkpoint_due()) {
            save();
        }
    }

    void save() const {
        if (!control_.on_checkpoint) {
            return;
        }
        BrownianState state = system_.state();
        control_.on_checkpoint({state.step, std::move(state.positions), std::move(state.list_reference),
                                std::move(state.near_reference), std::move(state.far_forces), sampler_.contacts(),
                                sampler_.series(), snapshots_});
    }

    BrownianRun describe() const {
        BrownianRun run;
        run.packing = packing();
        run.contacts = find_contacts(run.packing, options_.contact_tolerance);
        run.time = time();
        run.coordination = coordination_number(run.contacts);
        run.steps = system_.steps();
        run.time_step = time_step_;
        run.series = sampler_.series();
        run.snapshots = snapshots_;
        return run;
    }

    const Packing& start_;
    const BrownianOptions& options_;
    const Progress& progress_;
    const BrownianControl& control_;
    ReducedUnits units_;
    TimeStep time_step_;
    BrownianSystem system_;
    BrownianSampler sampler_;
    std::int64_t last_step_ = 0;
    std::int64_t sample_steps_ = 1;
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

Packing place_suspension(const SuspensionOptions& options, const Progress& progress) {
    require_between(options.volume_fraction, 0, 0.55, "the volume fraction of a suspension");
    require(options.radii.size() >= 2, "a suspension needs at least 2 particles");
    for (Index particle = 0; particle < options.radii.size(); ++particle) {
        require_positive(options.radii[particle], "the radius of particle " + std::to_string(particle), "m");
    }
    constexpr double gap = 0.1;           // of the radius, on each side
    constexpr double most_filled = 0.58;  // volume fraction of the spheres with their gaps: random ones still come apart
    constexpr double settled = 1e-6;      // rms force in units of stiffness and radius
    constexpr Index most_iterations = 100000;
    const double unit = options.radii.mean();
    const Eigen::VectorXd radii = options.radii / unit;
    const double solid = 4 * std::numbers::pi / 3 * radii.array().cube().sum();
    const Cell cell = Cell::periodic(Eigen::Vector3d::Constant(std::cbrt(solid / options.volume_fraction)));
    Eigen::Matrix3Xd positions(3, radii.size());
    for (Index particle = 0; particle < radii.size(); ++particle) {
        const auto number = static_cast<std::uint64_t>(particle);
        positions.col(particle) =
            random_uniform(options.seed, RandomPurpose::initial_position, 0, number).cwiseProduct(cell.lengths());
    }
    const double growth = std::min(1 + gap, std::cbrt(most_filled / options.volume_fraction));
    dem::ParticleSystem system(cell, positions, growth * radii, 0.6);
    dem::Fire fire(system, dem::Interactions<RepulsiveSpring, BondSpring>{RepulsiveSpring(1.0), BondSpring(1.0)}, 0.3, 0.6);
    Index iterations = 0;
    while (fire.iterate() > settled) {
        progress.update("placing particles", 0.0);
        if (++iterations > most_iterations) {
            throw InputError("the particles cannot be moved apart at volume fraction " + to_text(options.volume_fraction) +
                             ": ask for a lower one");
        }
    }
    return {Cell::periodic(unit * cell.lengths()), unit * system.positions(), options.radii};
}

}  // namespace coagula::generators
