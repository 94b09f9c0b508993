// SPDX-License-Identifier: GPL-3.0-or-later
// What images of the same particles show of errors of localisation: drawn anew against what the simulator expects, and measured.
#include <coagula/common/checks.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <gtest/gtest.h>

#include "hidden_effects.hpp"
#include "infer/candidate_measurements.hpp"
#include "responses/imaged_centres.hpp"
#include "support/reference_data.hpp"

#include "observables/observations.hpp"
#include "observables/repeated_images.hpp"

namespace coagula::diagnose {
namespace {

/// Images, each with its own errors, of particles that the simulator does not know.
Experiment imaged(const Settings& settings, std::uint64_t images, std::uint64_t seed, const Eigen::Vector3d& drift = {0, 0, 0}) {
    Packing hidden = structure(800, 79);
    std::vector<Measurement> tables;
    for (std::uint64_t image = 0; image < images; ++image) {
        tables.push_back(seen_by_microscope(hidden, settings.localisation_plane, settings.localisation_axis, settings.missed_share,
                                            seed + 2 * image));
        if (settings.false_share > 0) {
            add_false_centres(tables.back(), settings.false_share, 0.5e-6, seed + 2 * image + 1);
        }
        hidden.positions.colwise() += drift;
    }
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.measurements = {repeated(tables)};
    return experiment;
}

std::vector<Observation> differences_in(const Experiment& experiment) {
    std::vector<Observation> found;
    for (const Observation& one : observations_of(experiment)) {
        if (is<ImageDifference>(one)) {
            found.push_back(one);
        }
    }
    return found;
}

double centres_in(const Experiment& experiment) {
    return as<ImageDifference>(differences_in(experiment).at(0))->centres;
}

void expect_as_simulated(const Experiment& experiment, const Settings& settings) {
    const auto seen = differences_in(experiment);
    ASSERT_EQ(seen.size(), 3U);
    for (const bool exact : {false, true}) {
        const auto expected = repeated_images(simulator(), settings, exact);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(seen[k].value, expected[k], 3 * seen[k].standard_error + 0.01 * expected[k])
                << observable_of(seen[k]).key << (exact ? ", exact" : "");
        }
    }
}

TEST(RepeatedImages, ShowErrorsAsTheyAre) {
    const Experiment experiment = imaged(image_errors(2e-8, 5e-8, 0, 0), 2, 100);
    const auto seen = differences_in(experiment);
    ASSERT_EQ(seen.size(), 3U);
    EXPECT_NEAR(seen[0].value, 0.04, 3 * seen[0].standard_error);
    EXPECT_NEAR(seen[1].value, 0.10, 3 * seen[1].standard_error);
    EXPECT_LT(seen[0].standard_error / seen[0].value, 0.04);
    EXPECT_EQ(seen[2].value, 0);
    EXPECT_EQ(observable_of(seen[2]).key, "unmatched_share");
}

/// Errors so large that centres are taken for their neighbours, particles that are missed and centres that are none.
TEST(RepeatedImages, AreExpectedAsTheyAreSeen) {
    for (const Settings& settings :
         {image_errors(2e-8, 4e-8, 0.05, 0), image_errors(3e-8, 6e-8, 0.02, 0.09), image_errors(1e-7, 1.5e-7, 0.03, 0.03)}) {
        expect_as_simulated(imaged(settings, 2, 200), settings);
    }
}

TEST(RepeatedImages, OneAfterTheOtherShareTheirErrors) {
    const Settings settings = image_errors(2e-8, 4e-8, 0.03, 0);
    const Experiment four = imaged(settings, 4, 300);
    expect_as_simulated(four, settings);
    // Of a mean square successive difference of 4 numbers: 2 x 3^2 / (3 x 3 - 1) degrees of freedom in place of 1.
    EXPECT_NEAR(centres_in(four) / centres_in(imaged(settings, 2, 300)), 2.25, 0.05);
    const auto shells = [](const Experiment& experiment) { return observations_of(experiment).front(); };
    EXPECT_NEAR(shells(four).standard_error / shells(imaged(settings, 1, 300)).standard_error, 1, 0.2);
}

TEST(RepeatedImages, MayDriftAsAWhole) {
    const Settings settings = image_errors(2e-8, 4e-8, 0.02, 0);
    expect_as_simulated(imaged(settings, 3, 400, {6e-8, -4e-8, 9e-8}), settings);
}

TEST(RepeatedImages, OfExactCentresAreExpectedToAgree) {
    for (const bool exact : {false, true}) {
        EXPECT_EQ(repeated_images(simulator(), Settings{}, exact), (std::array<double, 3>{0, 0, 0}));
    }
}

/// A sheared gel at rest, imaged four times (Schwen et al. 2020): by the same rules with the nearest neighbours of scipy's cKDTree
/// a centre scatters by 5.52 nm in the plane and 7.76 nm along z.
TEST(RepeatedImages, OfARealGel) {
    const std::string path = testing::dataset("silica_gel_confocal/peri_static.csv");
    const Eigen::Matrix3Xd places = 1e-6 * testing::read_columns(path, 5);
    const Eigen::VectorXd frame = testing::read_columns(path, 4).row(0);
    std::vector<Eigen::Matrix3Xd> images(4, Eigen::Matrix3Xd(3, 0));
    for (Index row = 0; row < frame.size(); ++row) {
        Eigen::Matrix3Xd& image = images.at(static_cast<std::size_t>(frame[row]));
        image.conservativeResize(3, image.cols() + 1);
        image.rightCols<1>() = places.col(row);
    }
    const double diameter = 1.84e-6;
    const RepeatedImages seen = compare_images(images, diameter, "gel");
    EXPECT_NEAR(seen.values[0] * diameter, 5.519e-9, 1e-11);
    EXPECT_NEAR(seen.values[1] * diameter, 7.763e-9, 5e-11);
    EXPECT_EQ(seen.values[2], 0);
    EXPECT_NEAR(seen.centres, 312 * 6.0 / 8, 1e-9);
}

/// Beside every particle of the first image stands a centre that only it has: each of both is nearest to the one of the next image,
/// but that is nearest to the particle alone.
TEST(RepeatedImages, MatchOneCentreWithOne) {
    std::vector<Eigen::Matrix3Xd> images(2, Eigen::Matrix3Xd(3, 0));
    const auto add = [&](int image, double x, double y, double z) {
        images[static_cast<std::size_t>(image)].conservativeResize(3, images[static_cast<std::size_t>(image)].cols() + 1);
        images[static_cast<std::size_t>(image)].rightCols<1>() << x, y, z;
    };
    for (int x = 0; x < 5; ++x) {
        for (int y = 0; y < 5; ++y) {
            for (int z = 0; z < 5; ++z) {
                add(0, 3 * x, 3 * y, 3 * z);
                add(0, 3 * x, 3 * y + 0.4, 3 * z);
                add(1, 3 * x, 3 * y + (x % 2 == 0 ? 0.1 : -0.1), 3 * z);
            }
        }
    }
    const RepeatedImages seen = compare_images(images, 1, "lattice");
    EXPECT_EQ(seen.centres, 54);  // of the lattice those not in the faces, and their companions
    EXPECT_DOUBLE_EQ(seen.values[2], 0.5);
}

TEST(RepeatedImages, InAnotherUnitAreRefused) {
    for (const double unit : {0.1, 10.0, 1e-6, 1e6}) {
        Experiment experiment = imaged({}, 1, 500);
        for (Column& column : experiment.measurements[0].columns) {
            std::for_each(column.values.begin(), column.values.end(), [&](double& value) { value *= unit; });
        }
        EXPECT_THROW(observations_of(experiment), InputError) << unit;
    }
}

TEST(RepeatedImages, AreProposedWhereThereIsOneImage) {
    const auto proposed = [](const Experiment& experiment) { return candidates_for(experiment, observations_of(experiment)); };
    const Experiment once = imaged(image_errors(2e-8, 4e-8, 0, 0), 1, 600);
    ASSERT_EQ(proposed(once).size(), 1U);
    EXPECT_EQ(as<ImageDifference>(proposed(once).front().observations.front())->centres, 800);
    EXPECT_TRUE(proposed(imaged(image_errors(2e-8, 4e-8, 0, 0), 2, 600)).empty());
}

TEST(RepeatedImages, ThatAreTheSameAreRefused) {
    Experiment experiment = imaged({}, 2, 500);
    EXPECT_THROW(observations_of(experiment), InputError);
}

}  // namespace
}  // namespace coagula::diagnose
