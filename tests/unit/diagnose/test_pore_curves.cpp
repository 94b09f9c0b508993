// Pore curves as data: what is predicted, how structures scatter, and a hidden change of the structure.
#include "remade_structures.hpp"

#include "forward.hpp"
#include "pore_curves.hpp"

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
