// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian dynamics: bits, restart, bookkeeping and refusals. What the physics must give is in tests/validation/generators.
#include <coagula/common/failures.hpp>
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include "plateau.hpp"
#include "support/brownian_pairs.hpp"
#include "support/complaint.hpp"

#include <numbers>
#include <numeric>
#include <optional>
#include <string>

namespace coagula::generators {
namespace {

using coagula::testing::complaint;
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

/// Contacts that stick, slip and roll.
BrownianOptions rough_run() {
    BrownianOptions options = short_run();
    const double unit = examples::thermal / (radius * radius);
    options.resistance = {
        .tangential_stiffness = 1e5 * unit, .friction = 0.2, .rolling_stiffness = 1e5 * unit, .rolling_friction = 0.05};
    return options;
}

void expect_same(const BrownianRun& one, const BrownianRun& other) {
    EXPECT_TRUE((one.packing.positions.array() == other.packing.positions.array()).all());
    EXPECT_EQ(one.series.time, other.series.time);
    EXPECT_EQ(one.series.energy, other.series.energy);
    EXPECT_EQ(one.series.sliding_energy, other.series.sliding_energy);
    EXPECT_EQ(one.series.rolling_energy, other.series.rolling_energy);
    EXPECT_EQ(one.series.percolating, other.series.percolating);
    EXPECT_EQ(one.series.coordination, other.series.coordination);
    EXPECT_EQ(one.series.formed, other.series.formed);
    EXPECT_EQ(one.series.broken, other.series.broken);
    EXPECT_EQ(one.series.stress.strain, other.series.stress.strain);
    EXPECT_EQ(one.series.stress.shear_stress, other.series.stress.shear_stress);
    EXPECT_EQ(one.series.stress.contact_shear_stress, other.series.stress.contact_shear_stress);
    EXPECT_EQ(one.packing.cell.edges(), other.packing.cell.edges());
    ASSERT_EQ(one.snapshots.size(), other.snapshots.size());
    for (std::size_t number = 0; number < one.snapshots.size(); ++number) {
        EXPECT_EQ(one.snapshots[number].time, other.snapshots[number].time);
        EXPECT_TRUE((one.snapshots[number].positions.array() == other.snapshots[number].positions.array()).all());
    }
}

void expect_same_with_threads(const Packing& start, const BrownianOptions& options) {
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const BrownianRun one = simulate_brownian(start, dlvo(0), options);
    omp_set_num_threads(2);
    const BrownianRun two = simulate_brownian(start, dlvo(0), options);
    omp_set_num_threads(threads);
    EXPECT_GT(one.coordination, 0.5);
    expect_same(one, two);
}

TEST(BrownianDynamics, DoesNotDependOnTheNumberOfThreads) {
    expect_same_with_threads(suspension(4500), short_run());
}

TEST(BrownianDynamics, DoesNotDependOnTheNumberOfThreadsWithRoughContacts) {
    expect_same_with_threads(suspension(4500), rough_run());
}

Packing mixture(Index particles) {
    SuspensionOptions options;
    options.volume_fraction = 0.3;
    options.radii.resize(particles);
    for (Index particle = 0; particle < particles; ++particle) {
        options.radii[particle] = (particle % 2 == 0 ? 0.8 : 1.2) * radius;
    }
    return place_suspension(options);
}

/// Cancelled again and again, each time a little later.
void expect_same_in_pieces(const Packing& start, const BrownianOptions& options) {
    const BrownianRun whole = simulate_brownian(start, dlvo(0), options);
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
            pieces = simulate_brownian(start, dlvo(0), options, impatient, control);
        } catch (const Cancelled&) {
            ++resumed;
        }
    }
    EXPECT_GT(resumed, 2);
    expect_same(whole, *pieces);
    EXPECT_EQ(whole.snapshots.size(), options.snapshot_times.size());
}

TEST(BrownianDynamics, GoesOnToTheSameBits) {
    expect_same_in_pieces(suspension(1000), short_run());
}

TEST(BrownianDynamics, GoesOnToTheSameBitsWithRoughContactsOfUnequalParticles) {
    // Two chunks, so that contacts have two memories.
    expect_same_in_pieces(mixture(4000), rough_run());
}

/// The same in a flow that moves the box by several of its lengths.
BrownianOptions flowing_run() {
    BrownianOptions options = rough_run();
    options.snapshot_times.clear();
    options.flow.rate = 1.3 / options.stop_time;
    return options;
}

TEST(BrownianDynamics, DoesNotDependOnTheNumberOfThreadsInAFlow) {
    expect_same_with_threads(suspension(4000), flowing_run());
}

TEST(BrownianDynamics, GoesOnToTheSameBitsInAFlow) {
    expect_same_in_pieces(mixture(4000), flowing_run());
}

TEST(BrownianDynamics, RoughCrystalIsStableBelowTheBound) {
    // Twelve contacts each: what the bound is made for. A mode beyond it would grow a hundredfold within some steps.
    constexpr int cells = 5;
    constexpr double edge = 2.004 * std::numbers::sqrt2;
    constexpr Index particles = Index{4} * cells * cells * cells;
    Packing crystal{Cell::periodic(Eigen::Vector3d::Constant(cells * edge * radius)), Eigen::Matrix3Xd(3, particles),
                    Eigen::VectorXd::Constant(particles, radius)};
    for (Index particle = 0; particle < crystal.size(); ++particle) {
        const Index cell = particle / 4;
        const Eigen::Matrix<Index, 3, 1> along(cell % cells, cell / cells % cells, cell / cells / cells);
        Eigen::Vector3d place = along.cast<double>();
        if (particle % 4 > 0) {
            place += 0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(particle % 4 - 1));
        }
        crystal.positions.col(particle) = edge * radius * place;
    }
    BrownianOptions options;
    const double unit = examples::thermal / (radius * radius);
    options.resistance = {.tangential_stiffness = 8e5 * unit, .rolling_stiffness = 8e5 * unit};
    options.integrator = Integrator::euler;
    options.time_step = 0.98 * choose_time_step(dlvo(0), radius, 0, options).stability_bound;
    options.stop_time = 1500 * options.time_step;
    const BrownianRun run = simulate_brownian(crystal, dlvo(0), options);
    EXPECT_EQ(run.coordination, 12);
    // Equipartition: 500 spheres have 3000 modes, which share all energies.
    EXPECT_LT(run.series.sliding_energy.back() + run.series.rolling_energy.back(), 10 * 1500 * examples::thermal);
    EXPECT_GT(run.series.sliding_energy.back(), 0.1 * 1500 * examples::thermal);
}

TEST(BrownianDynamics, StopsWhenTheCoordinationIsLevel) {
    BrownianOptions options;
    options.stop_time = 0.1 * examples::diffusion_time();
    options.sample_interval = 5e-4 * examples::diffusion_time();
    options.stop_plateau = PlateauOf::coordination;
    options.plateau_time = 0.01 * examples::diffusion_time();
    options.plateau_change = 0.03;
    const BrownianRun run = simulate_brownian(suspension(300), dlvo(0), options);
    EXPECT_EQ(run.ended_by, "plateau");
    EXPECT_GT(run.coordination, 3);
    EXPECT_LT(run.time, options.stop_time);
    EXPECT_EQ(run.series.percolating.back(), 3);
    EXPECT_EQ(run.series.percolating.front(), 0);
    options.plateau_change = 0.01;
    EXPECT_GT(simulate_brownian(suspension(300), dlvo(0), options).time, run.time);
}

TEST(BrownianDynamics, PlateauIsThatOfTheMeans) {
    std::vector<double> time(41);
    std::iota(time.begin(), time.end(), 0.0);
    std::vector<double> values(41, 2.0);
    EXPECT_TRUE(is_plateau(time, values, 10, 1e-3));
    EXPECT_FALSE(is_plateau(time, values, 50, 1e-3));  // longer than the series
    EXPECT_FALSE(is_plateau(time, values, 4, 1e-3));   // too few samples
    for (std::size_t sample = 0; sample < values.size(); ++sample) {
        values[sample] = 2 + 0.01 * static_cast<double>(sample);
    }
    // Slope 0.01, halves of five samples: means 0.05 apart, the later 2.38.
    EXPECT_TRUE(is_plateau(time, values, 10, 0.0211));
    EXPECT_FALSE(is_plateau(time, values, 10, 0.0209));
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
    EXPECT_THROW(simulate_brownian(run.packing, dlvo(0), options), OutOfReach);  // is there already
}

TEST(BrownianDynamics, MovesUnequalParticles) {
    const BrownianRun run = simulate_brownian(mixture(300), dlvo(0), short_run());
    EXPECT_GT(run.coordination, 0.3);
    EXPECT_NEAR(run.series.mean_gap.back() / radius, 0.004, 0.004);
}

TEST(BrownianDynamics, SettlesOntoTheFloor) {
    const Packing start = suspension(300);
    BrownianOptions options = short_run();
    options.stop_time = 0.03 * examples::diffusion_time();
    options.sedimentation = {.gravity = 1e5, .density_difference = 2690};  // 109 kB T/R
    const BrownianRun run = simulate_brownian(start, dlvo(0.05), options);
    EXPECT_GT(run.packing.cell.lengths()[2], start.cell.lengths()[2] + 2 * radius);
    // No deeper in the walls than the noise of a step carries.
    const double noise = std::sqrt(2 * run.time_step.time_step / run.time_step.diffusion_time) * radius;
    EXPECT_GT(run.packing.positions.row(2).minCoeff(), radius - 6 * noise);
    EXPECT_LT(run.packing.positions.row(2).mean(), 0.9 * 0.5 * start.cell.lengths()[2]);
    options.sedimentation.density_difference *= -1;
    const BrownianRun creamed = simulate_brownian(start, dlvo(0.05), options);
    EXPECT_GT(creamed.packing.positions.row(2).mean() - radius, 1.1 * 0.5 * start.cell.lengths()[2]);
    EXPECT_LT(creamed.packing.positions.row(2).maxCoeff(), start.cell.lengths()[2] + radius + 6 * noise);
}

TEST(BrownianDynamics, MeanFieldSlowing) {
    EXPECT_EQ(mean_field_slowing(0), 1);
    EXPECT_NEAR((1 - mean_field_slowing(1e-4)) / 1e-4, 1.83, 0.005);  // Batchelor 1976, dilute hard spheres
    // Short-time self-diffusion of hard spheres up to phi = 0.5: Heinen, Banchio, Naegele, J. Chem. Phys. 135 (2011) 154504.
    double largest = 0;
    for (double phi = 0; phi <= 0.5; phi += 0.005) {
        const double published = 1 - 1.8315 * phi * (1 + 0.1195 * phi - 0.70 * phi * phi);
        largest = std::max(largest, std::abs(mean_field_slowing(phi) / published - 1));
    }
    EXPECT_LT(largest, 0.07);
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
    says(options, "needs a stop time, a stop coordination or a plateau");
    options = short_run();
    options.resistance.friction = 0.3;
    says(options, "a coefficient of friction needs a tangential stiffness");
    options.resistance = {.rolling_stiffness = 1};
    says(options, "resist rolling need a tangential stiffness");
    options.resistance = {.tangential_stiffness = 1, .rolling_friction = 1};
    says(options, "a coefficient of rolling friction needs a rolling stiffness");
    options.resistance = {.tangential_stiffness = -1};
    says(options, "the tangential stiffness is -1 N/m");
    options = short_run();
    options.sedimentation.gravity = 9.81;
    says(options, "gravity and a density difference need each other");
    options.sedimentation = {.gravity = -9.81, .density_difference = 1};
    says(options, "gravity is -9.81 m/s^2");
    options = short_run();
    options.stop_plateau = PlateauOf::mean_gap;
    options.plateau_time = 15 * options.sample_interval;
    says(options, "s needs at least 16 samples");
    options.plateau_time = unset;
    options.plateau_change = 0;
    says(options, "the change that counts as a plateau is 0");
    options = short_run();
    options.cutoff_gap = 5 * radius;
    says(options, "take more particles");
    options.cutoff_gap = 2000 * radius;
    says(options, "it may be 1000 at most");
    options.cutoff_gap = 1e-6 * radius;
    says(options, "take a longer cut-off");
    options = short_run();
    options.resistance.tangential_stiffness = 1e300;
    says(options, "too stiff for these particles");
    options = short_run();
    options.sedimentation = {.gravity = 1e300, .density_difference = 1000};
    says(options, "in a time step");

    BrownianCheckpoint smooth;
    smooth.positions = smooth.list_reference = smooth.near_reference = smooth.far_forces = start.positions;
    BrownianControl control;
    control.resume = &smooth;
    EXPECT_NE(complaint([&] { simulate_brownian(start, dlvo(0), rough_run(), {}, control); }).find("other resistance"),
              std::string::npos);

    Packing overlapping = start;
    overlapping.positions.col(7) = overlapping.positions.col(3) + Eigen::Vector3d(1.8 * radius, 0, 0);
    overlapping.positions.col(7) = overlapping.cell.wrap(overlapping.positions.col(7));
    EXPECT_NE(complaint([&] { simulate_brownian(overlapping, dlvo(0), short_run()); }).find("overlap by"), std::string::npos);
}

}  // namespace
}  // namespace coagula::generators
