// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/coagulation.hpp>

#include <coagula/common/failures.hpp>

namespace coagula::generators {

namespace {

/// As long as 15 mV take to a coordination of 5.4 (docs/explanation/brownian.md), in R^2/D; their barrier is 6 kT high.
constexpr double longest_coagulation = 4;
constexpr double highest_barrier = 8;     // kT
constexpr double sample_interval = 5e-4;  // R^2/D, as of a run that ends by its coordination alone

PairPotential potential_of(const CoagulationOptions& options, double radius, double surface_potential) {
    const PairRadii radii{radius, radius};
    const DoubleLayer layer{.surface_potential = surface_potential,
                            .debye_length = options.debye_length,
                            .relative_permittivity = options.relative_permittivity,
                            .temperature = options.temperature};
    return {{HamakerAttraction(options.hamaker_constant, radii), LinearSuperposition(layer, radii)},
            firm_contact(radius, options.temperature)};
}

/// Coagulation about to begin.
struct Coagulation {
    PairPotential potential;
    double barrier;  ///< [kT]
    BrownianOptions run;
};

Coagulation prepare(const CoagulationOptions& options) {
    const double radius = require_positive(options.sizes.mean_radius, "the mean particle radius", "m");
    require_between(options.volume_fraction, 0, 0.55, "the volume fraction of a suspension");
    require_between(options.target_coordination, 0, 12, "the target coordination");
    require(options.particles >= 2 && options.particles <= 100000000,
            "a suspension has 2 to 100 million particles, not " + std::to_string(options.particles));
    Coagulation made{potential_of(options, radius, options.surface_potential), unset, {}};
    made.barrier = made.potential.barrier_height(radius) / (boltzmann_constant * options.temperature);
    if (made.barrier > highest_barrier) {
        throw OutOfReach("nothing coagulates against a barrier of " + to_text(made.barrier) + " kT");
    }
    made.run.temperature = options.temperature;
    made.run.stop_coordination = options.target_coordination;
    made.run.seed = options.seed;
    const double diffusion_time = choose_time_step(made.potential, radius, radius, made.run).diffusion_time;
    made.run.stop_time = longest_coagulation * diffusion_time;
    made.run.sample_interval = sample_interval * diffusion_time;
    return made;
}

}  // namespace

ElasticContact firm_contact(double radius, double temperature) {
    constexpr double stiffness = 4e5;  // kB T/R^2
    constexpr double gap = 0.004;      // R
    return {stiffness * (boltzmann_constant * temperature) / (radius * radius), gap * radius};
}

Packing stabilised_suspension(const SuspensionOptions& suspension, const std::function<PairPotential(double)>& potential,
                              BrownianOptions run, double duration, const Progress& progress) {
    const Packing placed = place_suspension(suspension, progress);
    const double radius = mean_radius(placed);
    const PairPotential stable = potential(radius);
    run.time_step = unset;
    run.integrator = Integrator::stabilised;
    run.stop_coordination = unset;
    run.stop_plateau = PlateauOf::nothing;
    run.resistance = {};
    run.sedimentation = {};
    run.flow = {};
    run.sample_interval = unset;
    run.snapshot_times.clear();
    run.noise = RandomPurpose::equilibration;
    run.stop_time = std::isnan(duration) ? 0.25 * choose_time_step(stable, radius, radius, run).diffusion_time : duration;
    const Progress renamed([&progress](std::string_view, double fraction, std::string_view remark) {
        progress.update("equilibration", fraction, remark);
        return true;
    });
    return simulate_brownian(placed, stable, run, renamed).packing;
}

void check(const CoagulationOptions& options) {
    prepare(options);
}

Packing coagulate(const CoagulationOptions& options, const Progress& progress) {
    const Coagulation begun = prepare(options);
    const Packing start = stabilised_suspension(
        {options.volume_fraction, draw_radii(options.sizes, options.particles, options.seed), options.seed},
        [&](double radius) { return potential_of(options, radius, options.stabilising_potential); }, begun.run, unset, progress);
    BrownianRun made = simulate_brownian(start, begun.potential, begun.run, progress);
    if (made.ended_by != "coordination") {
        throw OutOfReach("within " + to_text(longest_coagulation) + " R^2/D the coordination comes to " +
                         to_text(made.coordination) + " only, against a barrier of " + to_text(begun.barrier) + " kT");
    }
    return std::move(made.packing);
}

}  // namespace coagula::generators
