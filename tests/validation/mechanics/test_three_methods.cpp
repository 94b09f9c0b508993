// SPDX-License-Identifier: GPL-3.0-or-later
// One modulus by three methods that share nothing but the contact law: explicit steps, quasi-static equilibria, linear solver.
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/quasistatic.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace coagula::mechanics {
namespace {

constexpr double strain = 1e-6;
constexpr int slow = 60000;  // steps of an oscillation; by 24000 a structure with soft parts is still 3 % too stiff

generators::VoidExpansion structure(Index voids) {
    generators::VoidExpansionOptions options;
    options.particles = 1000;
    options.voids = voids;
    options.volume_fraction = 0.4;
    options.seed = 7;
    options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
    return generators::expand_voids(options);
}

ContactModel springs() {
    ContactModel model;
    model.normal_stiffness = 100;
    model.shear_stiffness = 10;
    return model;
}

/// One oscillation in a sheared periodic cell; G' from its largest stress.
std::vector<double> explicit_moduli(const generators::VoidExpansion& sample, const std::vector<ShearOrientation>& orientations,
                                    int steps) {
    RheometerOptions options;
    options.model = springs();
    options.boundary = RheometerBoundary::periodic;
    options.amplitude = strain;
    options.oscillations = 1;
    options.steps_per_oscillation = steps;
    options.compare_with_rest = false;
    std::vector<double> moduli;
    for (const RheometerRun& run : run_rheometer(sample.packing, sample.contacts, options, orientations).runs) {
        moduli.push_back(run.oscillations.front().storage_modulus);
    }
    return moduli;
}

/// The strains of a plane have one modulus, whichever of its axes is the gradient.
std::vector<ShearOrientation> one_of_each_plane() {
    const auto all = all_orientations();
    return {all[0], all[1], all[3]};
}

double largest_deviation(const std::vector<double>& moduli, const LinearResponse& linear,
                         const std::vector<ShearOrientation>& orientations) {
    double largest = 0;
    for (std::size_t k = 0; k < moduli.size(); ++k) {
        const double expected = linear.shear_modulus(orientations[k].normal, orientations[k].direction);
        largest = std::max(largest, std::abs(moduli[k] / expected - 1));
    }
    return largest;
}

class ThreeMethods : public ::testing::TestWithParam<Index> {};

TEST_P(ThreeMethods, AgreeInAllOrientations) {
    const auto sample = structure(GetParam());
    const LinearResponse linear = solve_linear(sample.packing, sample.contacts);
    EXPECT_LT(
        largest_deviation(small_strain_moduli(sample.packing, sample.contacts, springs(), strain), linear, all_orientations()),
        1e-4);
    EXPECT_LT(largest_deviation(explicit_moduli(sample, one_of_each_plane(), slow), linear, one_of_each_plane()), 0.01);
}

INSTANTIATE_TEST_SUITE_P(VoidsOfThreeKinds, ThreeMethods, ::testing::Values(125, 500, 2000),
                         [](const auto& voids) { return std::to_string(voids.param) + "_voids"; });

TEST(ThreeMethods, ExplicitStepsConvergeAsTheRateFalls) {
    const auto sample = structure(500);
    const LinearResponse linear = solve_linear(sample.packing, sample.contacts);
    const std::vector<ShearOrientation> first{all_orientations().front()};
    const double fast = largest_deviation(explicit_moduli(sample, first, 3000), linear, first);
    const double slower = largest_deviation(explicit_moduli(sample, first, 24000), linear, first);
    EXPECT_GT(fast, 0.01) << "else the rate is not seen";
    EXPECT_LT(slower, 0.5 * fast);
}

}  // namespace
}  // namespace coagula::mechanics
