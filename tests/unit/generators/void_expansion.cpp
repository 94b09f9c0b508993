// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/void_expansion.hpp>

#include <coagula/generators/size_distribution.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include <chrono>

namespace coagula::generators {
namespace {

constexpr double r0 = 0.25e-6;

VoidExpansionOptions small(Index particles, Index voids, double volume_fraction = 0.4) {
    VoidExpansionOptions options;
    options.particles = particles;
    options.voids = voids;
    options.volume_fraction = volume_fraction;
    options.radii = Eigen::VectorXd::Constant(particles, r0);
    return options;
}

void expect_sound(const VoidExpansion& result, const VoidExpansionOptions& options) {
    EXPECT_NO_THROW(check(result.packing));
    EXPECT_NEAR(volume_fraction(result.packing), options.volume_fraction, 1e-12);
    EXPECT_EQ(result.packing.radii, options.radii);
    EXPECT_GE(result.coordination, options.target_coordination);
    EXPECT_EQ(result.coordination, coordination_number(find_contacts(result.packing, options.contact_tolerance)));
    EXPECT_LT(result.overlap_rms, 0.005);
    EXPECT_GE(result.overlap_max, result.overlap_rms);
    EXPECT_GT(result.void_radius, 0);
}

TEST(VoidExpansion, IsEqualBitForBitForAnyNumberOfThreads) {
    const auto run = [](int threads) {
        const int usual = omp_get_max_threads();
        omp_set_num_threads(threads);
        VoidExpansionOptions options = small(2100, 1600, 0.5);
        options.target_coordination = 3.8;
        VoidExpansion result = expand_voids(options);
        omp_set_num_threads(usual);
        return result;
    };
    const VoidExpansion one = run(1);
    const VoidExpansion two = run(2);
    EXPECT_EQ(one.packing.positions, two.packing.positions);
    EXPECT_EQ(one.steps, two.steps);
    EXPECT_EQ(one.overlap_rms, two.overlap_rms);
}

TEST(VoidExpansion, DependsOnTheSeed) {
    VoidExpansionOptions options = small(60, 30);
    const VoidExpansion first = expand_voids(options);
    EXPECT_EQ(first.packing.positions, expand_voids(options).packing.positions);
    options.seed = 2;
    EXPECT_NE(first.packing.positions, expand_voids(options).packing.positions);
}

TEST(VoidExpansion, HasNoLengthScaleOfItsOwn) {
    VoidExpansionOptions options = small(50, 25);
    const VoidExpansion small_scale = expand_voids(options);
    const double scale = 4194304;  // a power of two, so that rounding is the same
    options.radii *= scale;
    const VoidExpansion large_scale = expand_voids(options);
    EXPECT_EQ(large_scale.packing.positions, scale * small_scale.packing.positions);
    EXPECT_EQ(large_scale.void_radius, scale * small_scale.void_radius);
}

TEST(VoidExpansion, WorksWithASizeDistribution) {
    VoidExpansionOptions options = small(400, 200);
    options.radii = draw_radii({.kind = SizeKind::lognormal, .mean_radius = r0, .relative_deviation = 0.3}, 400, 5);
    expect_sound(expand_voids(options), options);
}

TEST(VoidExpansion, WorksOrSaysWhyNotForFewParticlesAndAnyVolumeFraction) {
    for (const Index particles : {3, 4, 10, 30}) {
        for (const double phi : {0.02, 0.1, 0.4, 0.6}) {
            for (const Index voids : {Index{1}, particles}) {
                const VoidExpansionOptions options = small(particles, voids, phi);
                try {
                    expect_sound(expand_voids(options), options);
                } catch (const InputError& error) {
                    EXPECT_GT(std::string(error.what()).size(), 40U);
                }
            }
        }
    }
}

TEST(VoidExpansion, WorksInDiluteAndInDensePackings) {
    VoidExpansionOptions dilute = small(300, 100, 0.1);
    dilute.target_coordination = 2.0;
    expect_sound(expand_voids(dilute), dilute);
    const VoidExpansionOptions dense = small(300, 100, 0.5);
    expect_sound(expand_voids(dense), dense);
}

TEST(VoidExpansion, SaysThatACoordinationCannotBeReached) {
    try {
        expand_voids(small(100, 500));
        FAIL() << "five voids per particle cannot reach 4.69";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("cannot reach a coordination of 4.69"), std::string::npos) << error.what();
    }
}

TEST(VoidExpansion, GivesUpOnlyWherePackingsFallShortOfTheTarget) {
    VoidExpansionOptions options = small(100, 300);
    options.target_coordination = 4.7;
    int found = 0;
    for (options.seed = 1; options.seed <= 10; ++options.seed) {
        try {
            expect_sound(expand_voids(options), options);
            ++found;
        } catch (const InputError& error) {
            const std::string sentence = error.what();
            const std::string before = "the packing comes to ";
            const double reached = std::stod(sentence.substr(sentence.find(before) + before.size()));
            EXPECT_TRUE(reached < 4.7 || sentence.find("still overlap by") != std::string::npos) << sentence;
        }
    }
    EXPECT_GT(found, 0);
}

TEST(VoidExpansion, SaysThatThePackingIsTooDenseForTheCoordination) {
    VoidExpansionOptions options = small(300, 100, 0.62);
    options.target_coordination = 1.0;
    try {
        expand_voids(options);
        FAIL() << "a packing at 0.62 has more than one contact per particle without voids";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("before any void has grown"), std::string::npos) << error.what();
    }
}

TEST(VoidExpansion, RejectsImpossibleOptions) {
    EXPECT_THROW(expand_voids(small(2, 1)), std::invalid_argument);
    EXPECT_THROW(expand_voids(small(100, 0)), std::invalid_argument);
    for (const double phi : {0.0, -0.4, 0.64, 0.9, unset}) {
        EXPECT_THROW(expand_voids(small(100, 50, phi)), std::invalid_argument);
    }
    VoidExpansionOptions options = small(100, 50);
    options.radii[7] = -1;
    EXPECT_THROW(expand_voids(options), std::invalid_argument);
    options = small(100, 50);
    options.radii.conservativeResize(99);
    EXPECT_THROW(expand_voids(options), std::invalid_argument);
    options = small(100, 50);
    options.target_coordination = 6;
    EXPECT_THROW(expand_voids(options), std::invalid_argument);
    options = small(100, 50);
    options.contact_tolerance = -0.01;
    EXPECT_THROW(expand_voids(options), std::invalid_argument);
}

TEST(VoidExpansion, ReportsProgressAndStopsAtOnceWhenCancelled) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point asked;
    double last = 0;
    int calls = 0;
    const Progress progress([&](std::string_view stage, double fraction, std::string_view remark) {
        EXPECT_EQ(stage, "void expansion");
        EXPECT_GE(fraction, last);
        EXPECT_LT(fraction, 1);
        last = fraction;
        if (++calls == 2000) {
            asked = Clock::now();
            EXPECT_NE(remark.find("coordination"), std::string_view::npos);
            return false;
        }
        return true;
    });
    EXPECT_THROW(expand_voids(small(500, 250), progress), Cancelled);
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 0.1);
    EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace coagula::generators
