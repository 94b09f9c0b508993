// SPDX-License-Identifier: GPL-3.0-or-later
// Runs whose particles another program moves.
#include <coagula/generators/engine_run.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"
#include "support/complaint.hpp"

#include <string>
#include <vector>

namespace coagula::generators {
namespace {

using coagula::testing::complaint;
using examples::dlvo;
using examples::radius;

Packing few_particles() {
    SuspensionOptions options;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(100, radius);
    return place_suspension(options);
}

/// Positions are kept at all samples but the first and the last.
BrownianOptions kept_run() {
    BrownianOptions options;
    options.time_step = 1e-5 * examples::diffusion_time();
    options.stop_time = 2000 * options.time_step;
    options.sample_interval = 500 * options.time_step;
    options.snapshot_times = {500 * options.time_step, 1000 * options.time_step, 1500 * options.time_step};
    return options;
}

/// Plays the positions of a run once more.
class Replay {
public:
    explicit Replay(const BrownianRun& run) : run_(run) {}
    Eigen::Matrix3Xd operator()(std::int64_t steps, const std::function<void()>& meanwhile) {
        steps_.push_back(steps);
        meanwhile();
        const std::size_t piece = steps_.size() - 1;
        return piece < run_.snapshots.size() ? run_.snapshots[piece].positions : run_.packing.positions;
    }
    const std::vector<std::int64_t>& steps() const { return steps_; }

private:
    const BrownianRun& run_;
    std::vector<std::int64_t> steps_;
};

TEST(EngineRun, MeasuresWhatTheBuiltinRunMeasures) {
    const Packing start = few_particles();
    const BrownianRun own = simulate_brownian(start, dlvo(0), kept_run());
    Replay replay(own);
    const auto move = [&](std::int64_t steps, const std::function<void()>& meanwhile) { return replay(steps, meanwhile); };
    const BrownianRun followed = follow_brownian(start, dlvo(0), kept_run(), own.time_step, move);
    EXPECT_EQ(replay.steps(), (std::vector<std::int64_t>{500, 500, 500, 500}));
    EXPECT_EQ(followed.series.time, own.series.time);
    EXPECT_EQ(followed.series.coordination, own.series.coordination);
    EXPECT_EQ(followed.series.largest, own.series.largest);
    EXPECT_EQ(followed.series.formed, own.series.formed);
    EXPECT_EQ(followed.ended_by, "time");
    EXPECT_EQ(followed.time, own.time);
    EXPECT_EQ(followed.coordination, own.coordination);
    EXPECT_EQ(followed.snapshots.size(), 3U);
    // The first positions that the builtin run observes are those of its start with some noise.
    for (std::size_t sample = 1; sample < own.series.energy.size(); ++sample) {
        EXPECT_NEAR(followed.series.energy[sample], own.series.energy[sample], 1e-6 * std::abs(own.series.energy[sample]));
    }
}

TEST(EngineRun, EndsAtTheCoordinationAndCanBeStopped) {
    const Packing start = few_particles();
    const BrownianRun own = simulate_brownian(start, dlvo(0), kept_run());
    BrownianOptions options = kept_run();
    options.snapshot_times.clear();
    options.stop_coordination = own.series.coordination[2];
    ASSERT_GT(options.stop_coordination, own.series.coordination[1]);
    Replay replay(own);
    const auto move = [&](std::int64_t steps, const std::function<void()>& meanwhile) { return replay(steps, meanwhile); };
    const BrownianRun followed = follow_brownian(start, dlvo(0), options, own.time_step, move);
    EXPECT_EQ(followed.ended_by, "coordination");
    EXPECT_EQ(followed.steps, 1000);
    const Progress stopping([](std::string_view, double, std::string_view) { return false; });
    EXPECT_THROW(follow_brownian(start, dlvo(0), options, own.time_step, move, stopping), Cancelled);
}

TEST(EngineRun, GivesParticlesAShortMemoryAndAStableStep) {
    const double unit = examples::diffusion_time();
    const InertialStep step = choose_inertial_step(dlvo(0), radius, radius, {});
    EXPECT_NEAR(step.memory / unit, 2e-6, 1e-12);
    // The leapfrog is stable up to 2 sqrt(m/k), with eight contacts of 4e5 or more.
    EXPECT_NEAR(step.time_step.stability_bound / unit, 2 * std::sqrt(2e-6 / (8 * 4e5)), 1e-8);
    EXPECT_NEAR(step.time_step.time_step / step.time_step.stability_bound, 0.5, 1e-12);
    const InertialStep over_barrier = choose_inertial_step(dlvo(0.015), radius, radius, {});
    EXPECT_LE(over_barrier.memory, 0.5 * over_barrier.time_step.accuracy_bound * (1 + 1e-12));
    BrownianOptions options;
    options.time_step = 0.9 * step.time_step.stability_bound;
    EXPECT_EQ(choose_inertial_step(dlvo(0), radius, radius, options).time_step.reason, "the option");
    options.time_step = 1.1 * step.time_step.stability_bound;
    EXPECT_NE(complaint([&] { choose_inertial_step(dlvo(0), radius, radius, options); }).find("the integrator is stable up to"),
              std::string::npos);
    options = {};
    options.sedimentation = {.gravity = 9.81, .density_difference = 1000};
    EXPECT_NE(complaint([&] { choose_inertial_step(dlvo(0), radius, radius, options); }).find("turn, settle or flow"),
              std::string::npos);
}

TEST(EngineRun, FadesTheForceAsTheBuiltinRunDoes) {
    const PairPotential potential = dlvo(0.015);
    const auto force = force_within_cutoff(potential, {}, radius);
    EXPECT_EQ(force(0.001 * radius), potential.force(0.001 * radius));
    EXPECT_EQ(force(0.05 * radius), potential.force(0.05 * radius));
    EXPECT_NEAR(force(0.5 * radius) / potential.force(0.5 * radius), 1, 1e-12);
    EXPECT_NEAR(force(0.9 * radius) / potential.force(0.9 * radius), 0.5, 1e-12);
    EXPECT_EQ(force(radius), 0);
}

}  // namespace
}  // namespace coagula::generators
