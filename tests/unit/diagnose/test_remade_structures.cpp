// SPDX-License-Identifier: GPL-3.0-or-later
// Causes that change the structures themselves: particles of several sizes.
#include "remade_structures.hpp"
#include "responses/imaged_centres.hpp"
#include "responses/linear_modulus.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using generators::SizeKind;

Settings with_sizes(double deviation) {
    Settings settings;
    settings.structures.size_deviation = deviation;
    return settings;
}

/// Mean number of neighbours between two distances over the diameter, pair by pair with the nearest image.
double neighbours_between(const Packing& packing, double low, double high) {
    const double diameter = 2 * mean_radius(packing);
    const Eigen::Array3d box = packing.cell.lengths().array();
    double count = 0;
    for (Index i = 0; i < packing.size(); ++i) {
        for (Index j = 0; j < packing.size(); ++j) {
            Eigen::Array3d branch = (packing.positions.col(j) - packing.positions.col(i)).array();
            branch -= box * (branch / box).round();
            const double distance = branch.matrix().norm() / diameter;
            count += i != j && distance >= low && distance < high ? 1 : 0;
        }
    }
    return count / static_cast<double>(packing.size());
}

constexpr std::size_t contact_shell = 4;  // 0.95 to 1.05 diameters

TEST(Polydispersity, WidensThePeakOfTheContactsAndKeepsCoordination) {
    const Packing equal = structure(recipe_particles, 1);
    const Packing unequal = structure_with_sizes(recipe_particles, 1, SizeKind::lognormal, 0.15);
    EXPECT_LT(neighbours_between(unequal, 0.95, 1.05), 0.6 * neighbours_between(equal, 0.95, 1.05));
    EXPECT_GT(neighbours_between(unequal, 0.75, 0.95), neighbours_between(equal, 0.75, 0.95) + 1);
    const auto coordination = [](const Packing& packing) {
        return 2.0 * static_cast<double>(find_contacts(packing, 0.01).size()) / static_cast<double>(packing.size());
    };
    EXPECT_NEAR(coordination(unequal), coordination(equal), 0.2);  // both pass the same target, by up to so much
}

TEST(Polydispersity, NodesAreTheStructuresThemselves) {
    constexpr double deviation = 0.4;  // the last node
    double counted = 0;
    for (const std::uint64_t seed : {1U, 2U}) {
        counted +=
            0.5 * neighbours_between(structure_with_sizes(recipe_particles, seed, SizeKind::lognormal, deviation), 0.95, 1.05);
    }
    EXPECT_NEAR(neighbours_in(recipe().simulator, with_sizes(deviation), contact_shell), counted, 1e-12);
    EXPECT_EQ(neighbours_in(recipe().simulator, with_sizes(0), contact_shell),
              neighbours_in(recipe().simulator, Settings{}, contact_shell));
}

/// Between the nodes as close to structures of that deviation as these are to each other.
TEST(Polydispersity, BetweenTheNodesStructuresAreMet) {
    for (const double deviation : {0.06, 0.13, 0.28}) {
        Simulator& exact = recipe().simulator.remade({.size_deviation = deviation});
        for (std::size_t shell = 2; shell < 10; ++shell) {
            const double counted = neighbours_in(exact, Settings{}, shell);
            const double scatter = std::sqrt(2 * std::max(counted, 1.0) / (2 * recipe_particles));
            EXPECT_NEAR(neighbours_in(recipe().simulator, with_sizes(deviation), shell), counted, 2.5 * scatter)
                << deviation << ", shell " << shell;
        }
        // The modulus of a structure of 300 particles scatters by 14 %, and two are compared with two.
        EXPECT_NEAR(linear_modulus(recipe().simulator, with_sizes(deviation)) / linear_modulus(exact, Settings{}), 1, 3 * 0.14);
    }
}

/// What is in the cache needs no structure: a second diagnosis makes none.
TEST(Polydispersity, StructuresAreMadeOnceAndOnlyWhenAskedFor) {
    Recipe first;
    neighbours(first.simulator, Settings{}, contact_shell);
    linear_modulus(first.simulator, Settings{});
    EXPECT_EQ(first.made, 0);
    neighbours(first.simulator, with_sizes(0.4), contact_shell);
    linear_modulus(first.simulator, with_sizes(0.4));
    EXPECT_EQ(first.made, 8);  // two structures at four nodes
    Recipe second;
    second.cache = first.cache;
    EXPECT_EQ(neighbours(second.simulator, with_sizes(0.4), contact_shell),
              neighbours(first.simulator, with_sizes(0.4), contact_shell));
    EXPECT_EQ(linear_modulus(second.simulator, with_sizes(0.4)), linear_modulus(first.simulator, with_sizes(0.4)));
    EXPECT_EQ(second.made, 0);
    Simulator of_files({structure(200, 1)}, {"file"}, first.cache);
    EXPECT_THROW(neighbours(of_files, with_sizes(0.1), contact_shell), std::invalid_argument);
}

/// Sizes that are normal, not lognormal, in structures of another number of particles, are seen through coordinates.
TEST(Polydispersity, HiddenInCoordinatesIsNamed) {
    std::vector<Measurement> tables;
    for (const std::uint64_t seed : {31U, 32U}) {
        tables.push_back(seen_by_microscope(structure_with_sizes(700, seed, SizeKind::normal, 0.12), 0, 0, 0, seed));
    }
    const Diagnosis found = diagnose_by_recipe(tables);
    EXPECT_TRUE(found.detected);
    ASSERT_FALSE(found.causes.empty());
    EXPECT_EQ(found.causes.front().name(), "polydispersity");
    EXPECT_TRUE(in_set(found, "polydispersity"));
    EXPECT_GT(found.gain.rmse_ratio, 2);
    const EstimatedParameter& deviation = found.causes.front().parameters[0];
    EXPECT_LT(deviation.low, 0.12);
    EXPECT_GT(deviation.high, 0.11);
}

/// Equal errors in all directions, no particle missed: sizes and errors of localisation look alike in one image of few particles
/// (of 700 the evidences differ by 4 logarithms). A second one of the same particles is proposed, and decides, whichever it is.
TEST(Polydispersity, TiesWithErrorsOfLocalisationUntilImagedTwice) {
    const Measurement once = seen_by_microscope(structure(400, 35), 2.5e-8, 2.5e-8, 0, 35);
    const Diagnosis found = diagnose_by_recipe({once});
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "polydispersity"));
    EXPECT_TRUE(in_set(found, "localisation-error"));
    for (const Misfit& misfit : found.misfits) {
        EXPECT_TRUE(std::isfinite(misfit.departure));
        EXPECT_FALSE(std::isnan(misfit.log_bayes_factor)) << misfit.axis;
    }
    ASSERT_EQ(found.proposals.size(), 1U);
    EXPECT_EQ(found.proposals.front().measurement, "images-again");
    EXPECT_GT(found.proposals.front().resolution, 0.95);

    const Diagnosis errors = diagnose_by_recipe({repeated({once, seen_by_microscope(structure(400, 35), 2.5e-8, 2.5e-8, 0, 36)})});
    EXPECT_EQ(errors.verdict, Verdict::named);
    EXPECT_EQ(names_of(errors.credible_set), std::vector<std::string>{"localisation-error"});
    const EstimatedParameter& plane = errors.causes.front().parameters[0];
    EXPECT_EQ(plane.name, "sigma_plane");
    EXPECT_NEAR(plane.value, 2.5e-8, 3 * (plane.high - plane.low) / 3.29);  // three standard deviations
    EXPECT_LT(plane.high / plane.low, 1.3);

    const Packing unequal = structure_with_sizes(700, 31, SizeKind::normal, 0.12);
    const Diagnosis sizes = diagnose_by_recipe(
        {repeated({seen_by_microscope(unequal, 0, 0, 0, 37), seen_by_microscope(unequal, 1e-10, 1e-10, 0, 38)})});
    EXPECT_EQ(sizes.verdict, Verdict::named);
    EXPECT_EQ(names_of(sizes.credible_set), std::vector<std::string>{"polydispersity"});
}

TEST(Polydispersity, EqualSpheresShowNone) {
    const Diagnosis found = diagnose_by_recipe(
        {seen_by_microscope(structure(700, 33), 0, 0, 0, 33), seen_by_microscope(structure(700, 34), 0, 0, 0, 34)});
    EXPECT_FALSE(found.detected);
}

}  // namespace
}  // namespace coagula::diagnose
