// Pore curves as data: what is predicted, how structures scatter, and a hidden change of the structure.
#include "remade_structures.hpp"

#include "observables/pore_curves.hpp"
#include "simulate/forward.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

TEST(PoreCurves, ArePredictedByTheStructures) {
    const Experiment experiment = experiment_of_recipe({pore_table(structures_of_recipe()[0])});
    const std::vector<Observation> observations = observations_of(experiment);
    ASSERT_GT(observations.size(), 18U);  // all but r = 0 and the largest pores
    ASSERT_LT(observations.size(), 25U);
    EXPECT_STREQ(observable_of(observations.front()), "exclusion_probability");
    EXPECT_FALSE(is_modulus(observations.front()));
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

TEST(PoreCurves, ScatterFromStructureToStructure) {
    constexpr int seeds = 10;
    constexpr Index particles = 200;
    const std::vector<double> places{0.3, 0.5, 0.7, 0.9, 1.1};
    Eigen::MatrixXd curves(seeds, static_cast<Index>(places.size()));
    for (int seed = 0; seed < seeds; ++seed) {
        const PoreCurve curve = pores_of(structure(particles, 100 + static_cast<std::uint64_t>(seed)));
        for (Index k = 0; k < curves.cols(); ++k) {
            curves(seed, k) = curve.at(places[static_cast<std::size_t>(k)] * 0.25e-6);
        }
    }
    const Eigen::RowVectorXd mean = curves.colwise().mean();
    double squares = 0;
    for (Index k = 0; k < curves.cols(); ++k) {
        const double variance = (curves.col(k).array() - mean[k]).square().sum() / (seeds - 1);
        squares += variance / std::pow(scatter_of_probability(mean[k], particles), 2) / static_cast<double>(curves.cols());
    }
    // A variance of ten curves, nearly one number each, has a standard error of a half.
    EXPECT_GT(std::sqrt(squares), 0.5);
    EXPECT_LT(std::sqrt(squares), 1.8);
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
            const double change = seen.mean() - simulator.exclusion_probability({}, pore);
            const double error = std::sqrt((seen.array() - seen.mean()).square().mean() / (images - 1));
            EXPECT_NEAR(simulator.exclusion_probability(settings, pore, true), seen.mean(), 5 * error);  // it draws nearly as many
            EXPECT_NEAR(simulator.exclusion_probability(settings, pore), seen.mean(), 5 * error + 0.1 * std::abs(change));
        }
    }
    const double pore = 1.25e-7;
    const double whole = simulator.exclusion_probability({}, pore);
    EXPECT_GT(simulator.exclusion_probability(image_errors(1e-9, 1e-9, 0.09, 0), pore), whole + 0.03);
    EXPECT_LT(simulator.exclusion_probability(image_errors(1e-9, 1e-9, 0, 0.08), pore), whole - 0.02);
}

/// Particles that are missed leave larger pores. Where the coordinates say so the pores need no other cause.
TEST(PoreCurves, BesideCoordinatesShowWhatIsMissed) {
    const Packing particles = structure(700, 61);
    const Measurement image = image_of(particles, image_errors(2e-8, 4e-8, 0.09, 0), 62);
    const Diagnosis found = diagnose_by_recipe({image, pore_table(as_spheres(image, particles))});
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(found.credible_set, std::vector<std::string>{"localisation-error"});
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
    ASSERT_FALSE(other.failures.empty());
    EXPECT_EQ(other.failures.front().axis, "pore_radius");
    EXPECT_EQ(other.failures.front().observable, "exclusion_probability");
    EXPECT_NE(other.failures.front().sentence.find("larger pores"), std::string::npos);
}

}  // namespace
}  // namespace coagula::diagnose
