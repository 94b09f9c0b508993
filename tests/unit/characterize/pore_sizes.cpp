// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/pore_sizes.hpp>

#include "test_packings.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <numbers>

namespace coagula::characterize {
namespace {

void expect_sane(const PoreSizes& pores, Index radii) {
    ASSERT_EQ(pores.radius.size(), radii);
    ASSERT_EQ(pores.exclusion_probability.size(), radii);
    EXPECT_TRUE(pores.exclusion_probability.allFinite());
    EXPECT_EQ(pores.radius[0], 0);
    EXPECT_DOUBLE_EQ(pores.radius[radii - 1], pores.max);
    EXPECT_EQ(pores.exclusion_probability[0], 1);
    EXPECT_EQ(pores.exclusion_probability[radii - 1], 0);
    for (Index k = 1; k < radii; ++k) {
        EXPECT_LE(pores.exclusion_probability[k], pores.exclusion_probability[k - 1]);
    }
    EXPECT_LT(pores.cell_volume_defect, 1e-11);
    EXPECT_GT(pores.mean, 0);
    EXPECT_GT(pores.median, 0);
    EXPECT_GT(pores.second_moment, pores.mean * pores.mean);
    EXPECT_LT(pores.mean, pores.max);
}

TEST(PoreSizes, OneParticleInABoxThatIsNoCube) {
    // Its cell is the box; the largest pore is at the box's corner. While the ball grows inside the box, P is known.
    Packing packing;
    packing.cell = Cell::periodic({2, 3, 5});
    packing.positions = Eigen::Vector3d(0.3, 2.9, 0.1);
    packing.radii = Eigen::VectorXd::Constant(1, 0.5);
    const PoreSizes pores = measure_pores(packing, {.radii = 50});
    expect_sane(pores, 50);
    EXPECT_NEAR(pores.max, Eigen::Vector3d(1, 1.5, 2.5).norm() - 0.5, 1e-12);
    const auto ball = [](double rho) { return 4 * std::numbers::pi / 3 * rho * rho * rho; };
    for (Index k = 0; k < 50 && pores.radius[k] <= 0.5; ++k) {
        EXPECT_NEAR(pores.exclusion_probability[k], (30 - ball(0.5 + pores.radius[k])) / (30 - ball(0.5)), 1e-12);
    }
}

TEST(PoreSizes, TwoParticles) {
    // A body-centred arrangement, and the same of unequal spheres.
    Packing packing = test::body_centred({1, 1, 1}, 1);
    expect_sane(measure_pores(packing), 200);
    packing.radii[1] = 0.7;
    const PoreSizes pores = measure_pores(packing, {.radii = 20});
    expect_sane(pores, 20);
    EXPECT_GT(pores.max, std::sqrt(5.0 / 3) - 1);
}

TEST(PoreSizes, ScaleWithTheUnitOfLength) {
    Packing packing = test::random_spheres(200, {5, 6, 7}, 0.3, 0.3, 3);
    const PoreSizes large = measure_pores(packing);
    packing.cell = Cell::periodic(packing.cell.lengths() * 1e-7);
    packing.positions *= 1e-7;
    packing.radii *= 1e-7;
    const PoreSizes small = measure_pores(packing);
    EXPECT_NEAR(small.mean / large.mean, 1e-7, 1e-18);
    EXPECT_NEAR(small.second_moment / large.second_moment, 1e-14, 1e-25);
    EXPECT_NEAR(small.volume / large.volume, 1e-21, 1e-32);
    EXPECT_LT((small.exclusion_probability - large.exclusion_probability).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(PoreSizes, SlopeAtZeroIsTheSurfacePerVoidVolume) {
    // Spheres that do not overlap: dP/dr = -3 phi / ((1 - phi) r0).
    Packing packing = test::lattice({{0, 0, 0}}, 2.19, {7, 8, 6}, 1);
    for (Index i = 0; i < packing.size(); ++i) {
        const auto noise = random_uniform(1, RandomPurpose::test, 2, static_cast<std::uint64_t>(i));
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i) + 0.18 * (noise.array() - 0.5).matrix());
    }
    const double phi = volume_fraction(packing);
    const PoreSizes pores = measure_pores(packing, {.radii = 4001});
    EXPECT_NEAR(pores.void_fraction, 1 - phi, 1e-12);
    const auto& p = pores.exclusion_probability;
    const double slope = (-3 * p[0] + 4 * p[1] - p[2]) / (2 * pores.radius[1]);
    EXPECT_NEAR(slope, -3 * phi / (1 - phi), 1e-4);
}

TEST(PoreSizes, UnequalPathAgreesWithEqualPath) {
    // Radii that differ in the tenth digit are measured with power diagrams, radius by radius.
    Packing packing = test::random_spheres(150, {5, 6, 7}, 0.4, 0.4, 6);
    const PoreSizes equal = measure_pores(packing, {.radii = 41});
    packing.radii[0] *= 1 + 1e-10;
    ASSERT_FALSE(is_monodisperse(packing));
    const PoreSizes unequal = measure_pores(packing, {.radii = 41, .tolerance = 0});
    expect_sane(unequal, 41);
    EXPECT_NEAR(unequal.max, equal.max, 1e-9);
    EXPECT_LT((unequal.exclusion_probability - equal.exclusion_probability).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(unequal.mean, equal.mean, 1e-8);
    EXPECT_EQ(unequal.curve_error, 0);
}

TEST(PoreSizes, InterpolationOfTheCurveOfUnequalSpheresStaysWithinItsTolerance) {
    const Packing packing = test::random_spheres(400, {7, 8, 7}, 0.3, 0.6, 6);
    const PoreSizes exact = measure_pores(packing, {.radii = 161, .tolerance = 0});
    const PoreSizes interpolated = measure_pores(packing, {.radii = 161, .tolerance = 3e-4});
    const double error = (interpolated.exclusion_probability - exact.exclusion_probability).cwiseAbs().maxCoeff();
    EXPECT_GT(error, 0);
    EXPECT_LT(error, interpolated.curve_error);
    EXPECT_LT(interpolated.curve_error, 3e-4);
    EXPECT_NEAR(interpolated.mean / exact.mean, 1, 1e-5);
    EXPECT_EQ(interpolated.max, exact.max);
}

TEST(PoreSizes, LargestPoreOfUnequalSpheresTouchesFour) {
    // Caesium-chloride arrangement of edge 2: the largest hole lies on the axis (t, 0, 1) of a face, where a sphere touches two
    // large spheres at corners of the cube and two small ones at centres of cubes.
    Packing packing = test::lattice({{0, 0, 0}, {.5, .5, .5}}, 2, {2, 2, 2}, 0.9);
    for (Index i = 1; i < packing.size(); i += 2) {
        packing.radii[i] = 0.6;
    }
    // Corners at (0, 0, 0) and (0, 0, 2), centres at (1, 1, 1) and (1, -1, 1); bisection for equal distance to both kinds.
    double low = 0, high = 1;
    for (int step = 0; step < 100; ++step) {
        const double t = (low + high) / 2;
        const double to_corners = std::sqrt(t * t + 1) - 0.9;
        const double to_centres = std::sqrt((1 - t) * (1 - t) + 1) - 0.6;
        (to_corners < to_centres ? low : high) = t;
    }
    const PoreSizes pores = measure_pores(packing, {.radii = 10});
    EXPECT_NEAR(pores.max, std::sqrt(low * low + 1) - 0.9, 1e-9);
}

TEST(PoreSizes, DoNotDependOnTheNumberOfThreads) {
    const int threads = omp_get_max_threads();
    const Packing equal = test::random_spheres(500, {8, 7, 9}, 0.5, 0.5, 8);
    const Packing unequal = test::random_spheres(100, {5, 4, 5}, 0.2, 0.6, 8);
    for (const Packing& packing : {equal, unequal}) {
        omp_set_num_threads(1);
        const PoreSizes one = measure_pores(packing, {.radii = 30});
        const SampledPores sampled_by_one = sample_pores(packing, one.radius, 20000, 5);
        omp_set_num_threads(2);
        const PoreSizes two = measure_pores(packing, {.radii = 30});
        const SampledPores sampled_by_two = sample_pores(packing, one.radius, 20000, 5);
        EXPECT_EQ(one.exclusion_probability, two.exclusion_probability);
        EXPECT_EQ(one.radius, two.radius);
        EXPECT_EQ(one.mean, two.mean);
        EXPECT_EQ(one.cell_volume_defect, two.cell_volume_defect);
        EXPECT_EQ(sampled_by_one.exclusion_probability, sampled_by_two.exclusion_probability);
    }
    omp_set_num_threads(threads);
}

TEST(PoreSizes, AreTheSameWhateverTheMemoryLooksLike) {
    const Packing equal = test::random_spheres(300, {6, 7, 8}, 0.4, 0.4, 9);
    const Packing unequal = test::random_spheres(100, {5, 4, 5}, 0.2, 0.6, 9);
    Packing open = equal;
    open.cell = Cell::open({0, 0, 0}, equal.cell.lengths());
    for (const Packing& packing : {equal, unequal, open, test::face_centred({3, 3, 3}, 0.5)}) {
        const PoreSizes first = measure_pores(packing, {.radii = 20});
        test::ScatteredMemory memory;
        for (int k = 0; k < 5; ++k) {
            memory.scatter();
            const PoreSizes again = measure_pores(packing, {.radii = 20});
            EXPECT_EQ(again.exclusion_probability, first.exclusion_probability);
            EXPECT_EQ(again.mean, first.mean);
            EXPECT_EQ(again.max, first.max);
            EXPECT_EQ(again.volume, first.volume);
        }
    }
}

TEST(PoreSizes, RefuseBadInput) {
    const Packing good = test::simple_cubic({2, 2, 2}, 1);
    EXPECT_THROW(measure_pores(Packing{}), std::invalid_argument);
    EXPECT_THROW(measure_pores(good, {.radii = 3}), std::invalid_argument);
    Packing full = good;
    full.radii.setConstant(2);
    EXPECT_THROW(measure_pores(full), std::invalid_argument);
    full.radii[0] = 1.9;
    EXPECT_THROW(measure_pores(full), std::invalid_argument);
    Packing needle = test::random_spheres(1, {1, 1, 1e7}, 0.1, 0.1, 1);
    EXPECT_THROW(measure_pores(needle), std::invalid_argument);
}

TEST(PoreSizes, CanBeCancelled) {
    const Progress progress([](std::string_view, double fraction, std::string_view) { return fraction < 0.5; });
    EXPECT_THROW(measure_pores(test::simple_cubic({3, 3, 3}, 1), {}, progress), Cancelled);
}

TEST(SampledPores, RefuseBadInput) {
    const Packing good = test::simple_cubic({2, 2, 2}, 1);
    EXPECT_THROW(sample_pores(good, Eigen::VectorXd(), 100, 1), std::invalid_argument);
    EXPECT_THROW(sample_pores(good, Eigen::Vector2d(0.2, 0.1), 100, 1), std::invalid_argument);
    EXPECT_THROW(sample_pores(good, Eigen::Vector2d(0.1, 0.2), 0, 1), std::invalid_argument);
    Packing open = good;
    open.cell = Cell::open({0, 0, 0}, {4, 4, 4});
    EXPECT_THROW(sample_pores(open, Eigen::Vector2d(0.1, 0.2), 100, 1), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::characterize
