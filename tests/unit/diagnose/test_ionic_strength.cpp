// SPDX-License-Identifier: GPL-3.0-or-later
// Structures that coagulated among more ions than the recipe assumes: what they do to the pores, and whether they are found there.
#include "data/knows.hpp"
#include "remade_structures.hpp"
#include "responses/pore_response.hpp"

#include <coagula/generators/coagulation.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

constexpr double sphere_radius = 0.25e-6;
constexpr double stated_potential = 0.0145;  // V: a barrier of 4.4 kT at a Debye length of 10 nm
constexpr int few = 200;

/// @param ions over those of a Debye length of 10 nm.
Packing coagulated_among(Index count, std::uint64_t seed, double ions, double potential = stated_potential) {
    generators::CoagulationOptions options;
    options.particles = count;
    options.sizes.mean_radius = sphere_radius;
    options.volume_fraction = 0.4;
    options.surface_potential = potential;
    options.debye_length = 1e-8 / std::sqrt(ions);
    options.seed = seed;
    return stored_structure("coagulated among ions", {static_cast<double>(count), static_cast<double>(seed), ions, potential},
                            [&] { return generators::coagulate(options); });
}

Simulator& recipe_with_barrier() {
    static SimulationCache cache;
    static Simulator simulator{{coagulated_among(few, 1, 1), coagulated_among(few, 2, 1)}, {"first", "second"}, cache};
    simulator.use({.make =
                       [](std::size_t k, const StructureChange& change) {
                           const bool changed = std::isfinite(change.surface_potential);
                           return coagulated_among(few, k + 1, change.ionic_strength,
                                                   changed ? change.surface_potential : stated_potential);
                       },
                   .name =
                       [](std::size_t, const StructureChange& change) {
                           return std::to_string(change.surface_potential) + " " + std::to_string(change.ionic_strength);
                       },
                   .measure_pores = measured_pores});
    return simulator;
}

Experiment experiment_behind_barrier(const std::vector<Measurement>& tables) {
    Experiment experiment = experiment_of_recipe(tables);
    experiment.recipe = {.generator = "brownian", .particles = few, .surface_potential = stated_potential, .seeds = {1, 2}};
    experiment.structure_sizes = {few, few};
    return experiment;
}

TEST(IonicStrength, MoreIonsMakePoresSmaller) {
    const auto large_pores = [](double ions) {
        Settings settings;
        settings.structures.ionic_strength = ions;
        return exclusion_probability(recipe_with_barrier(), settings, sphere_radius);
    };
    EXPECT_EQ(large_pores(1), exclusion_probability(recipe_with_barrier(), Settings{}, sphere_radius));
    EXPECT_NEAR(large_pores(4),
                exclusion_probability(recipe_with_barrier().remade({.ionic_strength = 4}), Settings{}, sphere_radius), 1e-12);
    EXPECT_LT(large_pores(2.3), 0.8 * large_pores(1));
}

TEST(IonicStrength, AppliesWhereTheRecipeHasABarrier) {
    const auto applies = [](const Experiment& experiment) {
        return find_mechanism("ionic-strength")->applies(knowledge_of(experiment));
    };
    const std::vector<Measurement> pores{pore_table(structures_of_recipe()[0])};
    Experiment experiment = experiment_behind_barrier(pores);
    EXPECT_TRUE(applies(experiment));
    experiment.recipe->surface_potential = 0;
    EXPECT_FALSE(applies(experiment));
    EXPECT_FALSE(applies(experiment_of_recipe(pores)));
    EXPECT_FALSE(applies(experiment_behind_barrier({})));
}

/// The hidden structures have other sizes and seeds than those of the simulation. At a lower potential there is no barrier either.
TEST(IonicStrength, HiddenInPoresIsFoundAndTiesWithAPotential) {
    DiagnosisOptions options;
    options.bootstrap = 399;
    options.causes = {"ionic-strength", "surface-potential"};
    const auto pores_of_two = [](double ions) {
        return experiment_behind_barrier(
            {pore_table(coagulated_among(300, 51, ions)), pore_table(coagulated_among(300, 52, ions))});
    };
    const Diagnosis found = diagnose(pores_of_two(2.2), recipe_with_barrier(), options);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "ionic-strength"));
    EXPECT_TRUE(in_set(found, "surface-potential"));
    EXPECT_GT(found.gain.rmse_ratio, 2);
    const Diagnosis nothing = diagnose(pores_of_two(1), recipe_with_barrier(), options);
    EXPECT_FALSE(nothing.detected) << nothing.p_value;
}

}  // namespace
}  // namespace coagula::diagnose
