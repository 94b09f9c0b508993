// The table of measures and the standard errors from blocks.
#include <coagula/characterize/measure.hpp>
#include <coagula/common/random.hpp>

#include <gtest/gtest.h>

#include <map>
#include <set>

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
