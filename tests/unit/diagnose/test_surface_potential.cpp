// SPDX-License-Identifier: GPL-3.0-or-later
// Structures that coagulated at another surface potential: what it does to them, and whether it is found in their pores.
#include "data/knows.hpp"
#include "observables/observations.hpp"
#include "remade_structures.hpp"
#include "responses/pore_response.hpp"

#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

constexpr double coagulated_radius = 0.15e-6;  // at 15 mV a barrier of 3.4 kT, which is simulated in seconds
constexpr Index particles = 200;

/// Van der Waals attraction of alumina in water and double layers of 10 nm.
generators::PairPotential potential(double surface_potential) {
    const generators::PairRadii radii{coagulated_radius, coagulated_radius};
    const generators::DoubleLayer layer{
        .surface_potential = surface_potential, .debye_length = 1e-8, .relative_permittivity = 81, .temperature = 293};
    const double thermal = generators::boltzmann_constant * 293;
    return {{generators::HamakerAttraction(4.76e-20, radii), generators::LinearSuperposition(layer, radii)},
            {4e5 * thermal / (coagulated_radius * coagulated_radius), 0.004 * coagulated_radius}};
}

/// Coagulated to a coordination of 4.6, from random positions.
Packing coagulate(Index count, std::uint64_t seed, double surface_potential, double deviation) {
    const generators::SizeDistribution sizes{
        .kind = generators::SizeKind::lognormal, .mean_radius = coagulated_radius, .relative_deviation = deviation};
    const Packing start = generators::place_suspension(
        {.volume_fraction = 0.4,
         .radii = deviation > 0 ? generators::draw_radii(sizes, count, seed) : Eigen::VectorXd::Constant(count, coagulated_radius),
         .seed = seed});
    generators::BrownianOptions options;
    options.stop_coordination = 4.6;
    options.seed = seed;
    return generators::simulate_brownian(start, potential(surface_potential), options).packing;
}

Packing coagulated(Index count, std::uint64_t seed, double surface_potential, double deviation = 0) {
    return stored_structure("coagulated", {static_cast<double>(count), static_cast<double>(seed), surface_potential, deviation},
                            [&] { return coagulate(count, seed, surface_potential, deviation); });
}

/// The recipe says 0 mV.
Simulator& recipe_without_barrier() {
    static SimulationCache cache;
    static Simulator simulator{{coagulated(particles, 1, 0), coagulated(particles, 2, 0)}, {"first", "second"}, cache};
    simulator.use({.make =
                       [](std::size_t k, const StructureChange& change) {
                           const bool changed = std::isfinite(change.surface_potential);
                           return coagulated(particles, k + 1, changed ? change.surface_potential : 0, change.size_deviation);
                       },
                   .name =
                       [](std::size_t, const StructureChange& change) {
                           return std::to_string(change.surface_potential) + " " + std::to_string(change.size_deviation);
                       },
                   .measure_pores = measured_pores});
    return simulator;
}

Experiment experiment_with(const std::vector<Measurement>& tables) {
    Experiment experiment = experiment_of_recipe(tables);
    experiment.sample.particle_radius = coagulated_radius;
    experiment.recipe = {.generator = "brownian", .particles = particles, .surface_potential = 0, .seeds = {1, 2}};
    experiment.structure_sizes = {particles, particles};
    return experiment;
}

Settings at(double surface_potential) {
    Settings settings;
    settings.structures.surface_potential = surface_potential;
    return settings;
}

TEST(SurfacePotential, ABarrierMakesStructuresMoreHeterogeneous) {
    const auto heterogeneity = [](double millivolt) {
        return characterize::fit_degree_of_heterogeneity(characterize::measure_pores(coagulated(400, 5, 1e-3 * millivolt)),
                                                         coagulated_radius)
            .a;
    };
    EXPECT_GT(heterogeneity(15), heterogeneity(0) + 0.03);
}

TEST(SurfacePotential, PoresFollowThePotential) {
    Simulator& recipe = recipe_without_barrier();
    const double none = exclusion_probability(recipe, Settings{}, coagulated_radius);
    const double high = exclusion_probability(recipe, at(0.015), coagulated_radius);
    EXPECT_NEAR(high, exclusion_probability(recipe.remade({.surface_potential = 0.015}), Settings{}, coagulated_radius), 1e-12);
    EXPECT_GT(high, none + pore_errors(recipe, {}, {coagulated_radius}).norm() / std::sqrt(2));  // of two structures
    // Behind a barrier structures scatter more.
    EXPECT_GT(pore_errors(recipe, {.surface_potential = 0.015}, {coagulated_radius}).norm(),
              1.2 * pore_errors(recipe, {}, {coagulated_radius}).norm());
    // Without a barrier there is nothing to feel.
    EXPECT_EQ(exclusion_probability(recipe, at(0.001), coagulated_radius),
              exclusion_probability(recipe, at(0.008), coagulated_radius));
}

TEST(SurfacePotential, AppliesWhereStructuresCoagulate) {
    const auto applies = [](const Experiment& experiment) {
        return find_mechanism("surface-potential")->applies(knowledge_of(experiment));
    };
    Experiment experiment = experiment_with({pore_table(coagulated(particles, 1, 0))});
    EXPECT_TRUE(applies(experiment));
    experiment.sample.particle_radius = 0.5e-6;
    EXPECT_FALSE(applies(experiment));
    experiment = experiment_with({});
    EXPECT_FALSE(applies(experiment));
    EXPECT_FALSE(applies(experiment_of_recipe({pore_table(coagulated(particles, 1, 0))})));
}

/// Two samples that coagulated against a barrier, other sizes and seeds than the simulation's.
TEST(SurfacePotential, HiddenInPoresIsFound) {
    Simulator& recipe = recipe_without_barrier();
    DiagnosisOptions options;
    options.bootstrap = 399;
    const Experiment hidden = experiment_with({pore_table(coagulated(300, 51, 0.0148)), pore_table(coagulated(300, 52, 0.0148))});
    const Diagnosis found = diagnose(hidden, recipe, options);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "surface-potential"));
    EXPECT_GT(found.gain.rmse_ratio, 2);
    const Diagnosis nothing = diagnose(experiment_with({pore_table(coagulated(300, 53, 0))}), recipe, options);
    EXPECT_FALSE(nothing.detected) << nothing.p_value;
}

}  // namespace
}  // namespace coagula::diagnose
