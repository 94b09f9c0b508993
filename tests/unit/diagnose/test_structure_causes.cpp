// SPDX-License-Identifier: GPL-3.0-or-later
// Structures that have another volume fraction, coordination or heterogeneity than the recipe says.
#include "data/knows.hpp"
#include "remade_structures.hpp"
#include "responses/imaged_centres.hpp"
#include "responses/linear_modulus.hpp"
#include "responses/pore_response.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

constexpr std::size_t any_shell = 9;

Experiment stated(const std::vector<Measurement>& tables) {
    Experiment experiment = experiment_of_recipe(tables);
    experiment.sample.volume_fraction = 0.4;
    return experiment;
}

Diagnosis diagnose_stated(const std::vector<Measurement>& tables) {
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(stated(tables), recipe().simulator, options);
}

bool applies(const std::string& cause, const Experiment& experiment) {
    return find_mechanism(cause)->applies(knowledge_of(experiment));
}

TEST(StructureChanges, NoneIsTheStructureAsItIs) {
    Settings none;
    none.structures.volume_fraction = 0;
    Recipe fresh;
    EXPECT_EQ(&fresh.simulator.remade({}), &fresh.simulator);
    EXPECT_EQ(neighbours(fresh.simulator, none, any_shell), neighbours(fresh.simulator, Settings{}, any_shell));
    EXPECT_EQ(fresh.made, 0);
}

/// Three standard deviations of the difference between two pairs of structures with so many neighbours, as if pairs were
/// independent.
double scatter_of_difference(double neighbours) {
    return 3 * std::sqrt(2 * 2 * std::max(neighbours, 1.0) / (2 * recipe_particles));
}

/// Between the nodes as close to structures that are made so as two pairs of these are to each other, in each shell and in all.
TEST(StructureChanges, BetweenTheNodesStructuresAreMet) {
    Settings dense;
    dense.structures.volume_fraction = 0.11;
    Settings connected;
    connected.structures.coordination = 4.8;
    Settings fewer_voids;
    fewer_voids.structures.voids = 0.2;
    for (const Settings& settings : {dense, connected, fewer_voids}) {
        const std::string name = name_of(settings.structures);
        Simulator& exact = recipe().simulator.remade(settings.structures);
        double all_counted = 0;
        double all_predicted = 0;
        for (std::size_t shell = 2; shell < 16; ++shell) {
            const double counted = neighbours_in(exact, Settings{}, shell);
            const double predicted = neighbours_in(recipe().simulator, settings, shell);
            EXPECT_NEAR(predicted, counted, scatter_of_difference(counted)) << name << ", shell " << shell;
            all_counted += counted;
            all_predicted += predicted;
        }
        EXPECT_NEAR(all_predicted, all_counted, scatter_of_difference(all_counted)) << name;
    }
}

/// As many neighbours touch as the coordination says, and the modulus follows.
TEST(StructureChanges, ContactsFollowTheCoordination) {
    Settings connected;
    connected.structures.coordination = 5.1;
    constexpr std::size_t contact_shell = 4;  // 0.95 to 1.05 diameters
    const double touching = neighbours_in(recipe().simulator, Settings{}, contact_shell);
    EXPECT_NEAR(neighbours_in(recipe().simulator, connected, contact_shell) - touching, 5.1 - 4.69, 0.25);
    EXPECT_GT(linear_modulus(recipe().simulator, connected), 1.2 * linear_modulus(recipe().simulator, Settings{}));
}

/// Fewer voids, larger pores.
TEST(StructureChanges, PoresFollowTheVoids) {
    Settings few;
    few.structures.voids = 0.125;
    EXPECT_GT(exclusion_probability(recipe().simulator, few, 0.25e-6),
              1.5 * exclusion_probability(recipe().simulator, Settings{}, 0.25e-6));
}

TEST(StructureCauses, ApplyWhereTheRecipeComesToAllOfTheirRange) {
    Experiment experiment = stated({pore_table(structures_of_recipe()[0])});
    const std::vector<std::string> causes{"volume-fraction", "coordination", "heterogeneity"};
    for (const std::string& cause : causes) {
        EXPECT_TRUE(applies(cause, experiment)) << cause;
    }
    experiment.sample.volume_fraction = 0.5;
    EXPECT_FALSE(applies("volume-fraction", experiment));
    EXPECT_TRUE(applies("coordination", experiment));
    EXPECT_FALSE(applies("heterogeneity", experiment));
    experiment = stated({pore_table(structures_of_recipe()[0])});
    experiment.recipe->generator = "brownian";
    experiment.recipe->surface_potential = 0;
    EXPECT_TRUE(applies("volume-fraction", experiment));
    EXPECT_FALSE(applies("coordination", experiment));
    EXPECT_FALSE(applies("heterogeneity", experiment));
    experiment.recipe->surface_potential = 0.014;
    EXPECT_FALSE(applies("volume-fraction", experiment));
    experiment.recipe.reset();
    for (const std::string& cause : causes) {
        EXPECT_FALSE(applies(cause, experiment)) << cause;
    }
}

/// At a volume fraction of 0.3 a void for each particle does not bring them to 4.9 contacts.
TEST(StructureCauses, ApplyToRecipesOfUsualContactsAndVoids) {
    Experiment experiment = stated({pore_table(structures_of_recipe()[0])});
    experiment.recipe->voids = recipe_particles;
    EXPECT_FALSE(applies("volume-fraction", experiment));
    EXPECT_FALSE(applies("coordination", experiment));
    EXPECT_TRUE(applies("heterogeneity", experiment));
    experiment.recipe->voids = recipe_particles / 8 + 1;
    EXPECT_TRUE(applies("volume-fraction", experiment));
    experiment.recipe->target_coordination = 5.3;
    EXPECT_FALSE(applies("volume-fraction", experiment));
    EXPECT_TRUE(applies("coordination", experiment));
    EXPECT_FALSE(applies("heterogeneity", experiment));
}

/// The ends of all ranges at the ends of the volume fractions that apply, which a diagnosis must not stop at.
TEST(StructureCauses, TheEndsOfTheirRangesCanBeMade) {
    const auto make = [](double voids, double volume_fraction, double coordination) {
        EXPECT_NO_THROW(structure_with_voids(recipe_particles, 3, voids, volume_fraction, coordination))
            << voids << ", " << volume_fraction << ", " << coordination;
    };
    for (const double coordination : {4.5, 4.9}) {
        for (const double volume_fraction : {0.35, 0.45}) {
            make(0.125, volume_fraction, coordination);
            make(1, volume_fraction, coordination);
        }
        for (const double volume_fraction : {0.85 * 0.355, 1.15 * 0.455}) {
            make(0.125, volume_fraction, coordination);
            make(0.5, volume_fraction, coordination);
        }
    }
    for (const double coordination : {4.3, 5.1}) {
        for (const double volume_fraction : {0.3, 0.5}) {
            make(0.125, volume_fraction, coordination);
            make(0.5, volume_fraction, coordination);
        }
    }
}

void expect_within(const EstimatedParameter& parameter, double truth) {
    EXPECT_LT(parameter.low, truth) << parameter.name;
    EXPECT_GT(parameter.high, truth) << parameter.name;
}

TEST(StructureCauses, AVolumeFractionInPoresIsNamed) {
    const Diagnosis found = diagnose_stated(
        {pore_table(structure_with_voids(500, 61, 0.5, 0.43)), pore_table(structure_with_voids(500, 62, 0.5, 0.43))});
    EXPECT_EQ(found.verdict, Verdict::named) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"volume-fraction"});
    expect_within(found.causes.front().parameters[0], 0.43 / 0.4);
    EXPECT_GT(found.gain.rmse_ratio, 2);
}

TEST(StructureCauses, HeterogeneityInPoresIsNamed) {
    const Diagnosis found =
        diagnose_stated({pore_table(structure_with_voids(500, 63, 0.16)), pore_table(structure_with_voids(500, 64, 0.16))});
    EXPECT_EQ(found.verdict, Verdict::named) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"heterogeneity"});
    expect_within(found.causes.front().parameters[0], 0.16);
    EXPECT_GT(found.gain.rmse_ratio, 2);
}

TEST(StructureCauses, ACoordinationInCoordinatesIsFound) {
    std::vector<Measurement> tables;
    for (const std::uint64_t seed : {65U, 66U}) {
        tables.push_back(seen_by_microscope(structure_with_voids(700, seed, 0.5, 0.4, 5.05), 0, 0, 0, seed));
    }
    const Diagnosis found = diagnose_stated(tables);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "coordination"));
    ASSERT_EQ(found.causes.front().name(), "coordination");
    expect_within(found.causes.front().parameters[0], 5.05);
}

TEST(StructureCauses, PoresAsTheRecipeHasThemShowNone) {
    const Diagnosis found =
        diagnose_stated({pore_table(structure_with_voids(500, 67, 0.5)), pore_table(structure_with_voids(500, 68, 0.5))});
    EXPECT_FALSE(found.detected) << found.p_value;
}

/// Of a level alone nobody knows which of many causes it is.
TEST(StructureCauses, ALevelAloneIsNeverOneOfThem) {
    Experiment experiment = stated({});
    experiment.sample.normal_stiffness = 100;
    experiment.sample.normal_stiffness_error = 0.05;
    Measurement sweep{.kind = MeasurementKind::frequency_sweep,
                      .label = "sweep",
                      .sample = "sample",
                      .columns = {{"frequency", "Hz", {}}},
                      .left_out = {}};
    Settings connected;
    connected.structures.coordination = 5.1;
    std::vector<std::complex<double>> moduli;
    for (int k = 0; k < 8; ++k) {
        sweep.columns[0].values.push_back(0.1 * std::pow(2, k));
        moduli.emplace_back(1.3 * linear_modulus(recipe().simulator, connected), 0);
    }
    add_moduli(sweep, moduli, 0.01, 69, false);
    experiment.measurements = {sweep};
    DiagnosisOptions options;
    options.bootstrap = 399;
    options.causes = {"volume-fraction", "coordination", "heterogeneity", "shear-stiffness"};
    const Diagnosis found = diagnose(experiment, recipe().simulator, options);
    EXPECT_TRUE(found.detected);
    EXPECT_NE(found.verdict, Verdict::named);
}

}  // namespace
}  // namespace coagula::diagnose
