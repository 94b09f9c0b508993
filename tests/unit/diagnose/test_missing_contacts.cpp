// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that are missing at random: the modulus that is left against effective-medium theory, and series of other structures.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "responses/thinned_contacts.hpp"

#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <utility>

namespace coagula::diagnose {
namespace {

/// Face-centred cubic, `cells` cells along each edge, spheres of 1 um that touch.
Packing crystal(int cells) {
    const double edge = 2e-6 * std::numbers::sqrt2;
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(cells * edge));
    packing.positions.resize(3, Index{4} * cells * cells * cells);
    packing.radii = Eigen::VectorXd::Constant(packing.positions.cols(), 1e-6);
    Index particle = 0;
    for (int x = 0; x < cells; ++x) {
        for (int y = 0; y < cells; ++y) {
            for (int z = 0; z < cells; ++z) {
                for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0.5, 0.5),
                                                      Eigen::Vector3d(0.5, 0, 0.5), Eigen::Vector3d(0.5, 0.5, 0)}) {
                    packing.positions.col(particle++) = edge * (Eigen::Vector3d(x, y, z) + corner);
                }
            }
        }
    }
    return packing;
}

std::set<std::pair<int, int>> pairs_of(const ContactNetwork& network) {
    std::set<std::pair<int, int>> pairs;
    for (Index contact = 0; contact < network.size(); ++contact) {
        pairs.insert({network.ends(0, contact), network.ends(1, contact)});
    }
    return pairs;
}

TEST(MissingContacts, WhatMissesMoreIsInWhatMissesLess) {
    const ContactNetwork whole = find_contacts(crystal(4), 0.01);
    const ContactNetwork some = thinned(whole, 0.2, 3);
    const ContactNetwork few = thinned(whole, 0.6, 3);
    EXPECT_EQ(some.size(), std::lround(0.8 * static_cast<double>(whole.size())));
    EXPECT_EQ(few.size(), std::lround(0.4 * static_cast<double>(whole.size())));
    const auto more = pairs_of(some);
    for (const auto& pair : pairs_of(few)) {
        EXPECT_TRUE(more.contains(pair));
    }
    EXPECT_NE(pairs_of(thinned(whole, 0.2, 4)), more);
    EXPECT_EQ(thinned(whole, 0, 1).ends, whole.ends);
}

/// Central springs on a lattice of 12 neighbours: G = G_0 (1 - x / (1 - 6 / 12)), exact for few missing ones (Feng, Thorpe and
/// Garboczi, Physical Review B 31 (1985) 276).
TEST(MissingContacts, FollowTheEffectiveMediumOfALattice) {
    SimulationCache cache;
    Simulator lattice({crystal(4)}, {"lattice"}, cache);
    Settings central;
    central.stiffness_ratio = 0;
    for (const double missing : {0.02, 0.1}) {
        EXPECT_NEAR(exact_thinned_response(lattice, central, missing), 1 - 2 * missing, 0.15 * missing) << missing;
    }
}

/// Monotone, one where nothing is missing, a thousandth where nothing bears; the curve is what the solver gives between its nodes.
TEST(MissingContacts, CurveAgreesWithTheSolver) {
    double before = 1;
    EXPECT_EQ(thinned_response(simulator(), 0), 1);
    for (const double missing : {0.01, 0.03, 0.05, 0.07, 0.09}) {
        const double curve = thinned_response(simulator(), missing);
        EXPECT_NEAR(curve, exact_thinned_response(simulator(), {}, missing), 0.04) << missing;
        EXPECT_LT(curve, before);
        before = curve;
    }
    EXPECT_EQ(thinned_response(simulator(), 0.39), 1e-3);
    Settings bending;
    bending.bending_ratio = 0.1;  // bonds that bend bear where others do not
    EXPECT_GT(exact_thinned_response(simulator(), bending, 0.09), 1.2 * thinned_response(simulator(), 0.09));
}

const std::vector<double> coordinations{5.4, 5.0, 4.7, 4.4, 4.15};

/// Two structures for each coordination.
struct Known {
    StoredSimulations stored{"missing_contacts"};
    std::vector<std::size_t> groups;
    std::vector<std::size_t> particles;
    std::optional<Simulator> simulator;

    Known() {
        std::vector<Packing> packings;
        std::vector<std::string> names;
        for (std::size_t row = 0; row < coordinations.size(); ++row) {
            for (std::uint64_t k = 1; k <= 2; ++k) {
                packings.push_back(structure(200, 100 * row + k, coordinations[row]));
                groups.push_back(row + 1);
                particles.push_back(static_cast<std::size_t>(packings.back().size()));
                names.push_back(std::to_string(names.size()));
            }
        }
        simulator.emplace(packings, names, stored.results(), Progress{}, groups);
    }
};

/// Other structures, each contact absent with this probability; mean of three, 3 % errors. (Where they are nearly floppy, the
/// quasi-static solver finds no equilibrium.)
Measurement series(double missing, std::uint64_t seed) {
    Column modulus{"storage_modulus", "Pa", {}};
    for (std::size_t row = 0; row < coordinations.size(); ++row) {
        double sum = 0;
        for (std::uint64_t k = 0; k < 3; ++k) {
            const Packing packing = structure(220, 5000 + 10 * row + k, coordinations[row]);
            const ContactNetwork whole = find_contacts(packing, 0.01);
            std::vector<Index> there;
            for (Index contact = 0; contact < whole.size(); ++contact) {
                const auto number = static_cast<std::uint64_t>(contact);
                if (random_uniform(seed + 100 * row + k, RandomPurpose::test, 9, number)[1] >= missing) {
                    there.push_back(contact);
                }
            }
            const ContactNetwork left{whole.particles, whole.ends(Eigen::all, there), whole.branch(Eigen::all, there)};
            mechanics::LinearOptions springs;
            springs.normal_stiffness = 40;
            springs.shear_stiffness = 4;
            sum += mechanics::solve_linear(packing, left, springs).mean_shear_modulus() / 3;
        }
        modulus.values.push_back(sum * (1 + 0.03 * drawn_normal(seed, row)));
    }
    const double stated =
        0.06 * *std::max_element(modulus.values.begin(), modulus.values.end());  // rows are three small structures
    modulus.standard_errors.assign(modulus.values.size(), stated);
    Measurement made;
    made.kind = MeasurementKind::structure_series;
    made.label = made.sample = "series";
    made.columns = {{"coordination", "1", coordinations}, modulus};
    return made;
}

Diagnosis diagnosis_of(const Measurement& table, double stiffness) {
    static Known known;
    Experiment experiment;
    experiment.structure_groups = known.groups;
    experiment.structure_sizes = known.particles;
    experiment.sample.normal_stiffness = stiffness;
    experiment.sample.normal_stiffness_error = 0.1;
    experiment.measurements = {table};
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(experiment, *known.simulator, options);
}

TEST(MissingContacts, AreInTheSetOfASeriesOfCoordinations) {
    EXPECT_FALSE(diagnosis_of(series(0, 1), 40).detected);
    const Diagnosis found = diagnosis_of(series(0.12, 2), 40);
    ASSERT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "missing-contacts")) << name_of(found.credible_set.front());
    const auto cause =
        std::find_if(found.causes.begin(), found.causes.end(), [](const Cause& one) { return one.name() == "missing-contacts"; });
    EXPECT_LT(cause->parameters[1].low, 0.12);
    EXPECT_GT(cause->parameters[1].high, 0.12);
}

/// One structure and one frequency: softer particles would do as well.
TEST(MissingContacts, AreNeverNamedFromTheLevelAlone) {
    const Packing packing = structure(260, 77);
    const ContactNetwork left = thinned(find_contacts(packing, 0.01), 0.1, 99);
    const double modulus = 0.4 * mechanics::solve_linear(packing, left, {}).mean_shear_modulus();
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.label = table.sample = "sample";
    Column time{"time", "s", {}};
    Column storage{"storage_modulus", "Pa", {}};
    for (std::size_t row = 0; row < 12; ++row) {
        time.values.push_back(60.0 * static_cast<double>(row + 1));
        storage.values.push_back(modulus * (1 + 0.02 * drawn_normal(6, row)));
        storage.standard_errors.push_back(0.02 * modulus);
    }
    table.columns = {time, storage};
    Experiment experiment;
    experiment.sample.normal_stiffness = 40;
    experiment.sample.normal_stiffness_error = 0.05;
    experiment.measurements = {table};
    DiagnosisOptions options;
    options.bootstrap = 399;
    const Diagnosis found = diagnose(experiment, simulator(), options);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(found.level_alone);
    EXPECT_NE(found.verdict, Verdict::named);
    EXPECT_TRUE(in_set(found, "missing-contacts")) << name_of(found.credible_set.front());
    EXPECT_TRUE(in_set(found, "none of the catalogue"));
}

}  // namespace
}  // namespace coagula::diagnose
