// SPDX-License-Identifier: GPL-3.0-or-later
// Structures of one trajectory are, bit by bit, those of a run each, and cost one run.
#include <coagula/stages/generate.hpp>

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::stages {
namespace {

using Values = std::map<std::string, Given>;

BrownianRun ending(const Values& options) {
    Values values{{"particles", std::int64_t{60}}, {"volume-fraction", 0.3},         {"radius", std::string("0.25um")},
                  {"surface-potential", 0.0},      {"sample-interval", 1.3e-5},      {"equilibration-time", 1e-4},
                  {"output", std::string("x.h5")}, {"contact-shear-stiffness", 1e-4}};
    values.insert(options.begin(), options.end());
    return brownian_run(Arguments(generate_brownian_verb(), {values, "", Caller::file}));
}

/// How often a work tells its progress.
class Told {
public:
    Progress progress() {
        return Progress([this](std::string_view, double, std::string_view) { return ++times_ > 0; });
    }
    int times() const { return times_; }

private:
    int times_ = 0;
};

void expect_equal(const Generated& one, const Generated& other) {
    EXPECT_EQ(one.structure.packing.positions, other.structure.packing.positions);
    EXPECT_EQ(one.structure.time, other.structure.time);
    ASSERT_EQ(one.findings.results.size(), other.findings.results.size());
    for (std::size_t k = 0; k < one.findings.results.size(); ++k) {
        EXPECT_EQ(one.findings.results[k].values, other.findings.results[k].values) << one.findings.results[k].path;
    }
}

/// Every run for itself beside all on one trajectory. Returns what the trajectory told over what the last run alone told.
double expect_as_alone(const std::vector<BrownianRun>& runs) {
    Trajectory trajectory;
    Told together;
    Told last;
    for (const BrownianRun& run : runs) {
        last = {};
        expect_equal(trajectory.next(run, together.progress()), generate(run, nullptr, last.progress()));
    }
    return static_cast<double>(together.times()) / last.times();
}

TEST(Trajectory, PassesCoordinations) {
    std::vector<BrownianRun> runs;
    for (const double coordination : {1.0, 1.02, 1.5, 2.0}) {  // a sample may pass two of them
        runs.push_back(ending({{"stop-coordination", coordination}}));
    }
    EXPECT_LT(expect_as_alone(runs), 1.1);
}

TEST(Trajectory, PassesTimesThatAreNoTimesOfSamples) {
    std::vector<BrownianRun> runs;
    for (const double time : {1e-4, 1.37e-4, 4.4e-4}) {
        runs.push_back(ending({{"stop-time", time}}));
    }
    EXPECT_LT(expect_as_alone(runs), 1.1);
}

/// A coordination that is not reached in time: the run ends with its time, and so does the next one.
TEST(Trajectory, EndsWithItsTime) {
    std::vector<BrownianRun> runs;
    for (const double coordination : {1.0, 5.5, 5.9}) {
        runs.push_back(ending({{"stop-coordination", coordination}, {"stop-time", 3e-4}}));
    }
    EXPECT_LT(expect_as_alone(runs), 1.1);
}

/// The start has more contacts than the first run is to end with; the next one begins anew.
TEST(Trajectory, GoesOnAfterAFailure) {
    Trajectory trajectory;
    const BrownianRun reached = ending({{"stop-coordination", 1.0}});
    EXPECT_THROW(trajectory.next(ending({{"stop-coordination", 1e-9}, {"contact-tolerance", 0.4}}), {}), std::exception);
    expect_equal(trajectory.next(reached, {}), generate(reached, nullptr, {}));
}

}  // namespace
}  // namespace coagula::stages
