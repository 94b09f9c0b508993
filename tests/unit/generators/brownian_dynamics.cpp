// Brownian dynamics: bits, restart, bookkeeping and refusals. What the physics must give is in tests/validation/generators.
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include "support/brownian_pairs.hpp"

#include <optional>
#include <string>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;

Packing suspension(Index particles) {
    SuspensionOptions options;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(particles, radius);
    return place_suspension(options);
}

BrownianOptions short_run() {
    BrownianOptions options;
    options.stop_time = 0.002 * examples::diffusion_time();
    options.sample_interval = options.stop_time / 8;
    options.snapshot_times = {0.0, options.stop_time / 2};
    return options;
}

void expect_same(const BrownianRun& one, const BrownianRun& other) {
    EXPECT_TRUE((one.packing.positions.array() == other.packing.positions.array()).all());
    EXPECT_EQ(one.series.time, other.series.time);
    EXPECT_EQ(one.series.energy, other.series.energy);
    EXPECT_EQ(one.series.coordination, other.series.coordination);
    EXPECT_EQ(one.series.formed, other.series.formed);
    EXPECT_EQ(one.series.broken, other.series.broken);
    ASSERT_EQ(one.snapshots.size(), other.snapshots.size());
    for (std::size_t number = 0; number < one.snapshots.size(); ++number) {
        EXPECT_EQ(one.snapshots[number].time, other.snapshots[number].time);
        EXPECT_TRUE((one.snapshots[number].positions.array() == other.snapshots[number].positions.array()).all());
    }
}

TEST(BrownianDynamics, DoesNotDependOnTheNumberOfThreads) {
    Packing start = suspension(4500);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const BrownianRun one = simulate_brownian(start, dlvo(0), short_run());
    omp_set_num_threads(2);
    const BrownianRun two = simulate_brownian(start, dlvo(0), short_run());
    omp_set_num_threads(threads);
    EXPECT_GT(one.coordination, 0.5);
    expect_same(one, two);
}

TEST(BrownianDynamics, GoesOnToTheSameBits) {
    const Packing start = suspension(1000);
    const BrownianOptions options = short_run();
    const BrownianRun whole = simulate_brownian(start, dlvo(0.012), options);
    // Cancelled again and again, each time a little later.
    std::optional<BrownianCheckpoint> kept;
    int resumed = 0;
    std::optional<BrownianRun> pieces;
    while (!pieces) {
        const std::optional<BrownianCheckpoint> from = kept;
        int reports = 0;
        const Progress impatient([&](std::string_view, double, std::string_view) { return ++reports < 2; });
        BrownianControl control;
        control.resume = from ? &*from : nullptr;
        control.on_checkpoint = [&](const BrownianCheckpoint& checkpoint) { kept = checkpoint; };
        try {
            pieces = simulate_brownian(start, dlvo(0.012), options, impatient, control);
        } catch (const Cancelled&) {
            ++resumed;
        }
    }
    EXPECT_GT(resumed, 2);
    expect_same(whole, *pieces);
    EXPECT_EQ(whole.snapshots.size(), 2U);
}

TEST(BrownianDynamics, KeepsItsBooks) {
    const BrownianRun run = simulate_brownian(suspension(1000), dlvo(0), short_run());
    const BrownianSeries& series = run.series;
    ASSERT_GE(series.time.size(), 9U);
    EXPECT_EQ(series.time.front(), 0);
    EXPECT_EQ(series.time.back(), run.time);
    EXPECT_EQ(series.coordination.back(), run.coordination);
    EXPECT_EQ(static_cast<double>(run.contacts.size()) / 500, run.coordination);
    std::int64_t contacts = std::lround(500 * series.coordination.front());
    for (std::size_t sample = 1; sample < series.time.size(); ++sample) {
        contacts += series.formed[sample] - series.broken[sample];
        EXPECT_EQ(contacts, std::lround(500 * series.coordination[sample]));
        EXPECT_LE(series.clusters[sample] + series.largest[sample], 1001);
    }
    EXPECT_LT(series.energy.back(), series.energy.front());
    EXPECT_NEAR(series.mean_gap.back() / radius, 0.004, 0.004);
}

TEST(BrownianDynamics, StopsAtTheCoordination) {
    BrownianOptions options;
    options.stop_coordination = 1;
    const BrownianRun run = simulate_brownian(suspension(500), dlvo(0), options);
    EXPECT_GE(run.coordination, 1);
    EXPECT_LT(run.coordination, 1.4);
    EXPECT_LT(run.series.coordination[run.series.coordination.size() - 2], 1);
}

TEST(BrownianDynamics, MovesUnequalParticles) {
    Eigen::VectorXd sizes(300);
    for (Index particle = 0; particle < 300; ++particle) {
        sizes[particle] = (particle % 2 == 0 ? 0.8 : 1.2) * radius;
    }
    SuspensionOptions mixture;
    mixture.volume_fraction = 0.3;
    mixture.radii = sizes;
    const BrownianRun run = simulate_brownian(place_suspension(mixture), dlvo(0), short_run());
    EXPECT_GT(run.coordination, 0.3);
    EXPECT_NEAR(run.series.mean_gap.back() / radius, 0.004, 0.004);
}

template <class Call>
std::string complaint(Call&& call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

TEST(BrownianDynamics, RefusesWhatIsImpossible) {
    const Packing start = suspension(100);
    const auto says = [&](const BrownianOptions& options, const std::string& part) {
        const std::string sentence = complaint([&] { simulate_brownian(start, dlvo(0), options); });
        EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    };
    BrownianOptions options = short_run();
    options.integrator = Integrator::euler;
    options.time_step = 1e-6;
    says(options, "the time step is 1e-06 s, but the integrator is stable up to 4.5");
    options = short_run();
    options.viscosity = -1;
    says(options, "the viscosity is -1 Pa s");
    options = short_run();
    options.stop_time = unset;
    says(options, "stop time or a stop coordination");
    options = short_run();
    options.cutoff_gap = 5 * radius;
    says(options, "take more particles");

    Packing overlapping = start;
    overlapping.positions.col(7) = overlapping.positions.col(3) + Eigen::Vector3d(1.8 * radius, 0, 0);
    overlapping.positions.col(7) = overlapping.cell.wrap(overlapping.positions.col(7));
    EXPECT_NE(complaint([&] { simulate_brownian(overlapping, dlvo(0), short_run()); }).find("overlap by"), std::string::npos);
}

}  // namespace
}  // namespace coagula::generators
