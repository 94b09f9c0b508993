// SPDX-License-Identifier: GPL-3.0-or-later
// Pore curves as data: what is predicted, how structures scatter, and a hidden change of the structure.
#include "remade_structures.hpp"
#include "responses/pore_response.hpp"

#include "chain/forward.hpp"
#include "chain/shared_errors.hpp"
#include "observables/observations.hpp"
#include "responses/pore_scatter.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <limits>

namespace coagula::diagnose {
namespace {

TEST(PoreCurves, ArePredictedByTheStructures) {
    const Experiment experiment = experiment_of_recipe({pore_table(structures_of_recipe()[0])});
    const std::vector<Observation> observations = observations_of(experiment);
    ASSERT_GT(observations.size(), 18U);  // all but r = 0 and the largest pores
    ASSERT_LT(observations.size(), 25U);
    EXPECT_EQ(observable_of(observations.front()).key, "exclusion_probability");
    EXPECT_FALSE(is_modulus_or_viscosity(observations.front()));
    const Eigen::VectorXd predicted = Forward(experiment, observations, recipe().simulator).predict(Settings{});
    for (const Index row : {0, 7, 17}) {
        double expected = 0;
        for (const Packing& packing : structures_of_recipe()) {
            const Eigen::VectorXd radius = Eigen::VectorXd::Constant(1, 0.05 * 0.25e-6 * static_cast<double>(row + 1));
            expected += 0.5 * characterize::sample_pores(packing, radius, 200000, 6).exclusion_probability[0];
        }
        EXPECT_NEAR(predicted[row], expected, 4 * 1.5e-3 * std::sqrt(0.5)) << row;
    }
}

/// Curves of many structures against what few of them say about their scatter.
TEST(PoreCurves, ScatterFromStructureToStructure) {
    constexpr Index seeds = 24;
    constexpr Index particles = 200;
    const std::vector<Index> radii{3, 5, 7, 9, 11};  // tenths of a particle radius
    const auto count = static_cast<Index>(radii.size());
    Eigen::MatrixXd curves(count, seeds);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(count, count);
    for (Index seed = 0; seed < seeds; ++seed) {
        const Packing packing = structure(particles, 100 + static_cast<std::uint64_t>(seed));
        const PoreCurve curve = pores_of(packing);
        const std::vector<double> covariance = covariance_of_pores(packing);
        const Eigen::Map<const Eigen::MatrixXd> all(covariance.data(), scatter_radii, scatter_radii);
        expected += all(radii, radii) / static_cast<double>(seeds);
        for (Index k = 0; k < count; ++k) {
            curves(k, seed) = curve.at(0.1 * static_cast<double>(radii[static_cast<std::size_t>(k)]) * 0.25e-6);
        }
    }
    const Eigen::MatrixXd deviations = curves.colwise() - curves.rowwise().mean();
    const Eigen::MatrixXd found = deviations * deviations.transpose() / (seeds - 1);
    // A variance of 24 curves has a standard error of 30 %.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(found);
    for (Index axis = count - 2; axis < count; ++axis) {
        const Eigen::VectorXd direction = axes.eigenvectors().col(axis);
        const double ratio = direction.dot(expected * direction) / axes.eigenvalues()[axis];
        EXPECT_GT(ratio, 0.5) << axis;
        EXPECT_LT(ratio, 3) << axis;
    }
}

/// All boxes cut from one crystal have the same pores.
TEST(PoreCurves, OfACrystalDoNotScatter) {
    constexpr Index cells = 4;
    constexpr double spacing = 2;
    Packing crystal{Cell::periodic(Eigen::Vector3d::Constant(4 * spacing)), Eigen::Matrix3Xd(3, cells * cells * cells), {}};
    for (Index k = 0; k < crystal.size(); ++k) {
        const Eigen::Vector3<Index> place(k % cells, (k / cells) % cells, k / (cells * cells));
        crystal.positions.col(k) = spacing * place.cast<double>();
    }
    crystal.radii = Eigen::VectorXd::Constant(crystal.size(), 1.01);  // the grid has 8 points in a unit cell
    for (const double value : covariance_of_pores(crystal)) {
        EXPECT_NEAR(value, 0, 1e-20);
    }
}

/// What two structures leave is the same in all tables; each sample has its scatter, unless the table states errors.
TEST(PoreCurves, TablesShareTheErrorsOfTheStructures) {
    const Measurement table = pore_table(structures_of_recipe()[0]);
    Measurement stated = table;
    stated.columns[1].standard_errors.assign(stated.rows(), 0.004);
    stated.columns[1].standard_errors[3] = std::numeric_limits<double>::quiet_NaN();
    const Experiment experiment = experiment_of_recipe({table, table, stated});
    const std::vector<Observation> observations = observations_of(experiment);
    const Index rows = static_cast<Index>(observations.size()) / 3;
    EXPECT_EQ(observations.front().standard_error, 0.002);
    EXPECT_EQ(observations.back().standard_error, 0.004);
    EXPECT_EQ(observations[static_cast<std::size_t>(2 * rows + 2)].standard_error, 0.002);  // r = 0 is left out

    Simulator& simulator = recipe().simulator;
    const Eigen::MatrixXd errors = shared_errors(experiment, observations, simulator);
    const Eigen::MatrixXd covariance = errors * errors.transpose();
    const Index row = 8;
    const double of_one = pore_errors(simulator, {}, {as<Pore>(observations[static_cast<std::size_t>(row)])->radius}).squaredNorm();
    EXPECT_GT(of_one, 1e-6);
    EXPECT_NEAR(covariance(row, row), 1.5 * of_one, 1e-6 * of_one);
    EXPECT_NEAR(covariance(row, row + rows), 0.5 * of_one, 1e-6 * of_one);
    EXPECT_NEAR(covariance(row + 2 * rows, row + 2 * rows), 0.5 * of_one, 1e-6 * of_one);
}

/// The centres of an image as spheres in the box of the particles.
Packing as_spheres(const Measurement& image, const Packing& particles) {
    Packing seen{particles.cell, Eigen::Matrix3Xd(3, static_cast<Index>(image.rows())), {}};
    for (Index centre = 0; centre < seen.size(); ++centre) {
        const auto row = static_cast<std::size_t>(centre);
        const Eigen::Vector3d place(image.columns[0].values[row], image.columns[1].values[row], image.columns[2].values[row]);
        seen.positions.col(centre) = particles.cell.wrap(place);
    }
    seen.radii = Eigen::VectorXd::Constant(seen.size(), mean_radius(particles));
    return seen;
}

Measurement image_of(const Packing& particles, const Settings& errors, std::uint64_t seed) {
    Measurement image =
        seen_by_microscope(particles, errors.localisation_plane, errors.localisation_axis, errors.missed_share, seed);
    if (errors.false_share > 0) {
        add_false_centres(image, errors.false_share, 2 * mean_radius(particles), seed + 1);
    }
    return image;
}

/// Images drawn another way of the structures that the simulator has.
TEST(PoreCurves, OfImagesAreExpectedAsTheyAreSeen) {
    constexpr std::uint64_t images = 10;
    Simulator& simulator = recipe().simulator;
    for (const Settings& settings : {image_errors(1.2e-7, 1.2e-7, 0, 0), image_errors(1e-9, 1e-9, 0.09, 0),
                                     image_errors(1e-9, 1e-9, 0, 0.08), image_errors(4e-8, 8e-8, 0.06, 0.03)}) {
        for (const double pore : {0.5e-7, 1.25e-7, 2e-7}) {
            Eigen::VectorXd seen(images);
            for (std::uint64_t k = 0; k < images; ++k) {
                const Packing& particles = structures_of_recipe()[k % 2];
                seen[static_cast<Index>(k)] = pores_of(as_spheres(image_of(particles, settings, 900 + 2 * k), particles)).at(pore);
            }
            const double change = seen.mean() - exclusion_probability(simulator, {}, pore);
            const double error = std::sqrt((seen.array() - seen.mean()).square().mean() / (images - 1));
            EXPECT_NEAR(exclusion_probability(simulator, settings, pore, true), seen.mean(), 5 * error);  // it draws nearly as many
            EXPECT_NEAR(exclusion_probability(simulator, settings, pore), seen.mean(), 5 * error + 0.1 * std::abs(change));
        }
    }
    const double pore = 1.25e-7;
    const double whole = exclusion_probability(simulator, {}, pore);
    EXPECT_GT(exclusion_probability(simulator, image_errors(1e-9, 1e-9, 0.09, 0), pore), whole + 0.03);
    EXPECT_LT(exclusion_probability(simulator, image_errors(1e-9, 1e-9, 0, 0.08), pore), whole - 0.02);
}

/// Particles that are missed leave larger pores. Where the coordinates say so the pores need no other cause.
TEST(PoreCurves, BesideCoordinatesShowWhatIsMissed) {
    const Packing particles = structure(700, 61);
    const Measurement image = image_of(particles, image_errors(2e-8, 4e-8, 0.09, 0), 62);
    const Diagnosis found = diagnose_by_recipe({image, pore_table(as_spheres(image, particles))});
    EXPECT_EQ(found.verdict, Verdict::named) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"localisation-error"});
    EXPECT_TRUE(found.base.parameters.empty());  // nothing shows a stiffness
    EXPECT_EQ(found.causes.front().draws.rows(), 4);
    const EstimatedParameter& missed = found.causes.front().parameters[2];
    EXPECT_EQ(missed.name, "missed_share");
    EXPECT_LT(missed.low, 0.09);
    EXPECT_GT(missed.high, 0.09);
    EXPECT_LT(missed.high / missed.low, 1.5);
}

/// A structure of another heterogeneity is detected, one of the same is not.
TEST(PoreCurves, ShowAnotherHeterogeneity) {
    const Diagnosis same = diagnose_by_recipe({pore_table(structure(300, 41)), pore_table(structure(300, 42))});
    EXPECT_FALSE(same.detected) << same.p_value;
    generators::VoidExpansionOptions options;
    options.particles = 300;
    options.voids = 30;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(300, 0.25e-6);
    const Diagnosis other = diagnose_by_recipe({pore_table(generators::expand_voids(options).packing)});
    EXPECT_TRUE(other.detected);
    ASSERT_FALSE(other.misfits.empty());
    EXPECT_EQ(other.misfits.front().axis, "pore_radius");
    EXPECT_EQ(other.misfits.front().observable, "exclusion_probability");
    EXPECT_TRUE(std::holds_alternative<SmoothMisfit>(other.misfits.front().what));
}

}  // namespace
}  // namespace coagula::diagnose
