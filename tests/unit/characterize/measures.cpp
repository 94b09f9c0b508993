// SPDX-License-Identifier: GPL-3.0-or-later
// The table of measures and the standard errors from blocks.
#include <coagula/characterize/measure.hpp>
#include <coagula/common/random.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <stdexcept>

#include "test_packings.hpp"

namespace coagula::characterize {
namespace {

/// Equal spheres at random in a cube of edge 10.
Packing spheres(Index particles) {
    return test::random_spheres(particles, Eigen::Vector3d::Constant(10), 0.4, 0.4, 5);
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Measures, NamesAreUniqueAndOptionsMeanTheSameEverywhere) {
    std::set<std::string> names;
    std::map<std::string, MeasureOption> options;
    for (const Measure& measure : measures()) {
        EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
        EXPECT_FALSE(measure.summary.empty()) << measure.name;
        for (const MeasureOption& option : measure.options) {
            const auto [place, is_new] = options.emplace(option.name, option);
            EXPECT_EQ(place->second.fallback, option.fallback) << option.name;
            EXPECT_EQ(place->second.meaning, option.meaning) << option.name;
        }
    }
    for (const Measure& measure : measures()) {
        for (const std::string& other : measure.along) {
            EXPECT_TRUE(names.contains(other)) << other;
        }
    }
}

TEST(Measures, EveryDatasetHasItsOwnPathUnitAndDescription) {
    const MeasureResult found = run_measures(MeasureInput(spheres(200)), {"all"});
    std::set<std::string> paths;
    for (const Dataset& dataset : found.datasets) {
        EXPECT_TRUE(paths.insert(dataset.path).second) << dataset.path;
        EXPECT_TRUE(dataset.path.starts_with("/characterization/")) << dataset.path;
        EXPECT_FALSE(dataset.unit.empty() || dataset.description.empty()) << dataset.path;
    }
}

TEST(Measures, OnlyTheNamedOnesAreRun) {
    const MeasureInput input(spheres(60), {{"contact-tolerance", 0.5}});
    const MeasureResult found = run_measures(input, {"coordination"});
    EXPECT_EQ(std::get<std::vector<double>>(found.datasets[4].values).front(), input.coordination().mean);
    EXPECT_FALSE(input.has_pores());
    EXPECT_EQ(found.fields.size(), 1U);
}

TEST(Measures, AnUnknownNameIsRefusedWithTheNamesThereAre) {
    const MeasureInput input(spheres(60));
    const std::string message = message_of([&] { run_measures(input, {"colour"}); });
    EXPECT_NE(message.find("'colour' is not one of coordination, doh"), std::string::npos) << message;
}

TEST(Measures, AnOptionWithoutValueIsNamed) {
    const MeasureInput input(spheres(60));
    EXPECT_EQ(input.count("radii"), 200);
    EXPECT_FALSE(input.has("samples"));
    EXPECT_NE(message_of([&] { run_measures(input, {"sampled_check"}); }).find("samples"), std::string::npos);
}

/// A measure that fails in a way of its own.
Measure failing(const std::string& name, MeasureResult (*run)(const MeasureInput& input)) {
    return {.name = name, .summary = "fails", .run = run};
}

std::vector<Measure> table_with_failures() {
    const auto& all = measures();
    const auto coordination = std::find_if(all.begin(), all.end(), [](const Measure& one) { return one.name == "coordination"; });
    return {failing("first", [](const MeasureInput&) -> MeasureResult { throw std::domain_error("Error in function f:\n  no"); }),
            *coordination, failing("memory", [](const MeasureInput&) -> MeasureResult { throw std::bad_alloc(); }),
            failing("own", [](const MeasureInput&) -> MeasureResult { throw std::runtime_error("the fit did not end"); }),
            failing("number", [](const MeasureInput&) {
                MeasureResult result;
                result.add("number/value", std::numeric_limits<double>::infinity(), "1", "no number");
                return result;
            })};
}

TEST(Measures, OneThatFailsTakesNoOtherWithIt) {
    const MeasureInput input(spheres(60), {{"contact-tolerance", 0.5}});
    for (const std::vector<std::string>& only :
         {std::vector<std::string>{}, {"all"}, {"own", "coordination", "first", "memory", "number"}}) {
        const MeasureResult found = run_measures(input, only, table_with_failures());
        EXPECT_EQ(found.value("coordination"), run_measures(input, {"coordination"}).value("coordination"));
        EXPECT_EQ(found.reason_left_out("coordination"), "");
        EXPECT_EQ(found.reason_left_out("own"), "the fit did not end");
        EXPECT_EQ(found.reason_left_out("memory"), "there is not enough memory for this");
        EXPECT_EQ(found.reason_left_out("number"), "its result number/value is not a finite number");
        const std::string first = found.reason_left_out("first");
        EXPECT_NE(first.find("Error in function f: no"), std::string::npos) << first;
        EXPECT_EQ(first.find('\n'), std::string::npos) << first;
        EXPECT_TRUE(std::isnan(found.value("number/value")));
    }
}

TEST(Measures, WhereAllFailTheFirstReasonIsAnError) {
    const MeasureInput input(spheres(60));
    try {
        run_measures(input, {"own", "memory"}, table_with_failures());
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "memory: there is not enough memory for this");
    }
}

TEST(Measures, WhatIsWrongForAllOfThemAndACancelledRunEndThemAll) {
    const MeasureInput input(spheres(60));
    EXPECT_THROW(run_measures(input, {}, {failing("a", [](const MeasureInput&) -> MeasureResult { throw InputError("no"); })}),
                 InputError);
    EXPECT_THROW(run_measures(input, {}, {failing("a", [](const MeasureInput&) -> MeasureResult { throw Cancelled(); })}),
                 Cancelled);
    EXPECT_THROW(
        run_measures(input, {}, {failing("a", [](const MeasureInput&) -> MeasureResult { throw std::invalid_argument("no"); })}),
        std::invalid_argument);
}

/// Positions as files in single precision have them.
Packing in_single_precision(Packing packing) {
    packing.positions = packing.positions.cast<float>().cast<double>();
    return packing;
}

/// Hexagonal close packing of touching spheres of radius 1 in a box of right angles: four spheres in a cell.
Packing hexagonal_packing(const Eigen::Vector3i& cells) {
    const Eigen::Vector3d edges(2, 2 * std::sqrt(3.0), 4 * std::sqrt(2.0 / 3));
    Packing packing;
    packing.cell = Cell::periodic(edges.cwiseProduct(cells.cast<double>()));
    packing.positions.resize(3, 4 * cells.prod());
    packing.radii = Eigen::VectorXd::Ones(packing.positions.cols());
    Index next = 0;
    for (int k = 0; k < cells.prod(); ++k) {
        const Eigen::Vector3d corner(k % cells[0], k / cells[0] % cells[1], k / (cells[0] * cells[1]));
        for (const Eigen::Vector3d& site : {Eigen::Vector3d(0, 0, 0), {0.5, 0.5, 0}, {0.5, 1.0 / 6, 0.5}, {0, 2.0 / 3, 0.5}}) {
            packing.positions.col(next++) = (corner + site).cwiseProduct(edges);
        }
    }
    return packing;
}

TEST(Measures, OfACrystalWithTheNoiseOfSinglePrecision) {
    const double sixteenth = 1.0 / 16;  // apart from the faces of the box
    for (Packing crystal : {hexagonal_packing({3, 3, 3}), hexagonal_packing({4, 2, 3}), test::simple_cubic({5, 5, 5}, 1),
                            test::face_centred({3, 3, 3}, 1), test::body_centred({4, 4, 4}, 1)}) {
        crystal.positions.array() += sixteenth;
        const double volume = crystal.cell.volume() / static_cast<double>(crystal.size());
        const MeasureResult found = run_measures(MeasureInput(in_single_precision(crystal)));
        EXPECT_EQ(found.reason_left_out("voronoi"), "");
        EXPECT_NEAR(found.value("voronoi/mean"), volume, 1e-9 * volume);
        EXPECT_LT(found.value("voronoi/width"), narrowest_gamma_law);
        EXPECT_TRUE(std::isnan(found.value("voronoi/shape")));  // there is no gamma law of cells that are all alike
        EXPECT_GT(found.value("coordination"), 5.9);
    }
}

TEST(Measures, TheGammaLawIsFittedDownToItsLimit) {
    for (const double width : {1e-8, 1e-6, 1e-5, 9e-4, 1.1e-3, 1e-2, 0.3}) {
        Eigen::VectorXd volumes(1000);
        for (Index k = 0; k < volumes.size(); ++k) {  // equal steps have the standard deviation 1 / sqrt(12) of their range
            volumes[k] =
                smallest_voronoi_volume + 0.1 * (1 + width * std::sqrt(12.0) * ((static_cast<double>(k) + 0.5) / 1000 - 0.5));
        }
        const VoronoiDistribution found = fit_voronoi_volumes(volumes, 1);
        EXPECT_NEAR(found.width, width, 2e-3 * width + 1e-12);
        EXPECT_EQ(std::isfinite(found.shape), width > narrowest_gamma_law) << width;
        if (width > narrowest_gamma_law && width < 0.1) {
            EXPECT_NEAR(found.shape * width * width, 1, 0.02) << width;
        }
    }
}

/// No fraction beyond 0 and 1, no negative variance, length, area or eigenvalue, whatever the packing.
TEST(Measures, ImpossibleValuesAreNotAmongTheResults) {
    const auto is_signed = [](const std::string& path) {
        for (const char* name :
             {"euler", "mean_curvature", "transformed", "fabric/tensor", "gap", "doh/b", "self_stress", "trend"}) {
            if (path.find(name) != std::string::npos) {
                return true;
            }
        }
        return false;
    };
    std::vector<Packing> packings;
    for (const Index count : {1, 3, 12}) {
        packings.push_back(test::random_spheres(count, Eigen::Vector3d::Constant(5), 0.4, 0.4, 3));
        packings.push_back(test::random_spheres(count, Eigen::Vector3d(3, 5, 9), 0.3, 0.6, 4));
        Packing open = test::random_spheres(count, Eigen::Vector3d::Constant(4), 0.5, 0.5, 6);
        open.cell = Cell::open(Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(5));
        packings.push_back(std::move(open));
    }
    packings.push_back(test::simple_cubic({3, 3, 3}, 1));
    packings.push_back(test::lattice({{.1, .1, .1}}, 2, {1, 6, 6}, 0.99));  // a plane
    for (const Packing& packing : packings) {
        const MeasureInput input(packing,
                                 {{"samples", 500}, {"most-voxels", 4000}, {"voxels-per-radius", 1}, {"contact-tolerance", 0.2}});
        for (const Dataset& dataset : run_measures(input, {"all"}).datasets) {
            const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
            for (const double value : numbers != nullptr ? *numbers : std::vector<double>()) {
                EXPECT_TRUE(std::isfinite(value)) << dataset.path << ", " << packing.size() << " particles";
                EXPECT_TRUE(is_signed(dataset.path) || value >= 0)
                    << dataset.path << " " << value << ", " << packing.size() << " particles";
                EXPECT_TRUE(dataset.path.find("fraction") == std::string::npos || value <= 1 + 1e-12)
                    << dataset.path << " " << value;
            }
        }
    }
}

TEST(Blocks, ShareOutAllParticlesOfACube) {
    const Packing packing = spheres(5000);
    const Blocks blocks = make_blocks(packing);
    ASSERT_EQ(blocks.count, 27);
    const Eigen::MatrixXd sums = sum_by_block(blocks, Eigen::RowVectorXd::Ones(packing.size()));
    EXPECT_EQ(sums.sum(), 5000);
    EXPECT_GT(sums.minCoeff(), 100);
    EXPECT_EQ(make_blocks(spheres(63)).count, 0);
}

TEST(Blocks, LeaveOutParticlesThatDoNotCount) {
    const Packing packing = spheres(200);
    std::vector<bool> counted(200, true);
    counted[7] = false;
    const Blocks blocks = make_blocks(packing, counted);
    EXPECT_EQ(blocks.of_particle[7], -1);
    EXPECT_EQ(sum_by_block(blocks, Eigen::RowVectorXd::Ones(200)).sum(), 199);
}

/// For a mean of independent equally large blocks leaving out one at a time gives s / sqrt(B) exactly.
TEST(Blocks, ErrorOfAMeanIsThatOfTheTextbook) {
    constexpr Index blocks = 10;
    Eigen::MatrixXd sums(2, blocks);
    for (Index block = 0; block < blocks; ++block) {
        sums(0, block) = random_normal(3, RandomPurpose::test, 0, static_cast<std::uint64_t>(block))[0];
        sums(1, block) = 1;
    }
    const double mean = sums.row(0).mean();
    const double deviation = std::sqrt((sums.row(0).array() - mean).square().sum() / (blocks - 1));
    const Eigen::VectorXd error =
        block_errors(sums, [](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, sum[0] / sum[1]); });
    EXPECT_NEAR(error[0], deviation / std::sqrt(blocks), 1e-12);
}

}  // namespace
}  // namespace coagula::characterize
