// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of a recipe, and those that the diagnosis makes again, for tests.
#pragma once

#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "observables/neighbour_shells.hpp"
#include "responses/imaged_centres.hpp"

#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/generators/size_distribution.hpp>

namespace coagula::diagnose {

/// Void expansion with sizes of particles.
inline Packing structure_with_sizes(Index particles, std::uint64_t seed, generators::SizeKind kind, double deviation) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 2;
    options.volume_fraction = 0.4;
    options.radii =
        generators::draw_radii({.kind = kind, .mean_radius = 0.25e-6, .relative_deviation = deviation}, particles, seed);
    options.seed = seed;
    return stored_structure("sizes",
                            {static_cast<double>(particles), static_cast<double>(seed), static_cast<double>(kind), deviation},
                            [&] { return generators::expand_voids(options).packing; });
}

/// Void expansion with a number of voids per particle.
inline Packing structure_with_voids(Index particles, std::uint64_t seed, double voids, double volume_fraction = 0.4,
                                    double target_coordination = unset) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = std::lround(voids * static_cast<double>(particles));
    options.volume_fraction = volume_fraction;
    options.radii = Eigen::VectorXd::Constant(particles, 0.25e-6);
    options.target_coordination = std::isnan(target_coordination) ? options.target_coordination : target_coordination;
    options.seed = seed;
    return stored_structure(
        "voids", {static_cast<double>(particles), static_cast<double>(seed), voids, volume_fraction, options.target_coordination},
        [&] { return generators::expand_voids(options).packing; });
}

constexpr int recipe_particles = 300;

inline PoreCurve pores_of(const Packing& packing) {
    const characterize::PoreSizes pores = characterize::measure_pores(packing);
    return {pores.max, {pores.exclusion_probability.begin(), pores.exclusion_probability.end()}};
}

/// The same by sampling, for unequal spheres.
inline PoreCurve sampled_pores_of(const Packing& packing) {
    const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(200, 0, 4 * mean_radius(packing));
    const Eigen::VectorXd found = characterize::sample_pores(packing, radius, 100000, 3).exclusion_probability;
    return {4 * mean_radius(packing), {found.begin(), found.end()}};
}

inline PoreCurve measured_pores(const Packing& packing) {
    return is_monodisperse(packing) ? pores_of(packing) : sampled_pores_of(packing);
}

/// Neighbours in a shell of the plane and in that along z together.
inline double neighbours_in(Simulator& simulator, const Settings& settings, std::size_t shell) {
    return neighbours(simulator, settings, shell) + neighbours(simulator, settings, shell + shells_of_direction);
}

/// The pore curve of a structure as a table, 25 radii to 1.25 particle radii.
inline Measurement pore_table(const Packing& packing) {
    Measurement table{.kind = MeasurementKind::pore_curve,
                      .label = "pores",
                      .sample = "sample",
                      .columns = {{"pore_radius", "m", {}}, {"exclusion_probability", "1", {}}},
                      .left_out = {}};
    const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(26, 0, 1.25 * mean_radius(packing));
    const Eigen::VectorXd found = characterize::sample_pores(packing, radius, 200000, 5).exclusion_probability;
    table.columns[0].values = {radius.begin(), radius.end()};
    table.columns[1].values = {found.begin(), found.end()};
    return table;
}

inline const std::vector<Packing>& structures_of_recipe() {
    static const std::vector<Packing> made{structure(recipe_particles, 1), structure(recipe_particles, 2)};
    return made;
}

/// A structure of the recipe with a change.
inline Packing remade_structure(std::size_t structure, const StructureChange& change) {
    const std::uint64_t seed = structure + 1;
    if (change.size_deviation > 0) {
        return structure_with_sizes(recipe_particles, seed, generators::SizeKind::lognormal, change.size_deviation);
    }
    const double voids = std::isfinite(change.voids) ? change.voids : 0.5;
    return structure_with_voids(recipe_particles, seed, voids, 0.4 * (1 + change.volume_fraction),
                                std::isfinite(change.coordination) ? change.coordination : unset);
}

inline std::string name_of(const StructureChange& change) {
    std::string name;
    for (const double value : {change.size_deviation, change.volume_fraction, change.coordination, change.voids}) {
        name += std::to_string(value) + " ";
    }
    return name;
}

/// Two structures of a void expansion recipe that can be made again; `made` counts how often.
struct Recipe {
    SimulationCache cache = {};
    int made = 0;
    Simulator simulator{structures_of_recipe(), {"first", "second"}, cache};

    Recipe() {
        simulator.use({.make =
                           [this](std::size_t k, const StructureChange& change) {
                               ++made;
                               return remade_structure(k, change);
                           },
                       .name = [](std::size_t, const StructureChange& change) { return name_of(change); },
                       .measure_pores = measured_pores});
    }
    Recipe(const Recipe&) = delete;
    Recipe& operator=(const Recipe&) = delete;
    ~Recipe() = default;
};

inline Recipe& recipe() {
    static Recipe one;
    return one;
}

/// Measured tables beside the recipe.
inline Experiment experiment_of_recipe(const std::vector<Measurement>& tables) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.recipe = {.generator = "vem", .particles = recipe_particles, .voids = recipe_particles / 2, .seeds = {1, 2}};
    experiment.structure_sizes = {recipe_particles, recipe_particles};
    experiment.measurements = tables;
    for (std::size_t k = 0; k < tables.size(); ++k) {
        experiment.measurements[k].label = "table " + std::to_string(k + 1);
        experiment.measurements[k].sample = "sample " + std::to_string(k + 1);
    }
    return experiment;
}

inline Diagnosis diagnose_by_recipe(const std::vector<Measurement>& tables) {
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(experiment_of_recipe(tables), recipe().simulator, options);
}

}  // namespace coagula::diagnose
