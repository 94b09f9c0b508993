// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian dynamics against closed forms: free diffusion, Boltzmann distributions, the rate over the barrier.
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <cstdio>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;
using examples::thermal;

TEST(BrownianPhysics, FreeParticlesDiffuse) {
    // 30 000 particles so dilute that hardly two meet: the mean square after a time t is 6 D t to 0.5 %.
    constexpr Index particles = 30000;
    SuspensionOptions dilute;
    dilute.volume_fraction = 1e-4;
    dilute.radii = Eigen::VectorXd::Constant(particles, radius);
    const Packing start = place_suspension(dilute);
    BrownianOptions options;
    options.stop_time = 0.1 * examples::diffusion_time();
    options.sample_interval = options.stop_time;
    const BrownianRun run = simulate_brownian(start, dlvo(0.05), options);
    double sum = 0;
    for (Index particle = 0; particle < particles; ++particle) {
        const Eigen::Vector3d way = run.packing.positions.col(particle) - start.positions.col(particle);
        sum += start.cell.minimum_image(way).squaredNorm();
    }
    const double diffusion = thermal / (6 * std::numbers::pi * 1e-3 * radius);
    EXPECT_NEAR(sum / particles / (6 * diffusion * run.time), 1, 0.01);
    EXPECT_NEAR(sum / particles / (radius * radius), 0.6, 0.006);
}

/// A basin that holds the pairs: nothing up to 0.4 radii, 30 kB T higher at 0.7.
TabulatedLaw basin() {
    std::vector<double> gaps;
    std::vector<double> energies;
    for (int row = 0; row <= 70; ++row) {
        const double gap = 0.01 * row;
        gaps.push_back(gap * radius);
        const double way = std::max(0.0, gap - 0.4) / 0.3;
        energies.push_back(30 * thermal * way * way * (3 - 2 * way));
    }
    return {gaps, energies};
}

/// Gaps at many times of pairs that start in equilibrium somewhere.
std::vector<double> watch_pairs(const PairPotential& potential, int side, double start_gap, BrownianOptions options, int times,
                                double interval) {
    const Packing start = examples::lattice_of_pairs(side, [&](int) { return start_gap; });
    const double tau = examples::diffusion_time();
    options.stop_time = 2 * times * interval * tau;
    options.sample_interval = options.stop_time;
    for (int time = 0; time < times; ++time) {
        options.snapshot_times.push_back((times + time) * interval * tau);
    }
    const BrownianRun run = simulate_brownian(start, potential, options);
    std::vector<double> gaps;
    for (const Snapshot& snapshot : run.snapshots) {
        const std::vector<double> more = examples::gaps_of(start.cell, snapshot.positions);
        gaps.insert(gaps.end(), more.begin(), more.end());
    }
    return gaps;
}

TEST(BrownianPhysics, SecondaryMinimumHasItsBoltzmannDistribution) {
    const PairPotential potential = dlvo(0.02, {basin()});
    BrownianOptions options;
    options.time_step = 2e-5 * examples::diffusion_time();
    const std::vector<double> gaps = watch_pairs(potential, 14, 0.2, options, 40, 0.002);
    constexpr int bins = 20;
    constexpr double low = 0.06;
    constexpr double high = 0.56;
    const double all = examples::boltzmann_integral(potential, low, 0.66);
    double distance = 0;
    for (int bin = 0; bin < bins; ++bin) {
        const double left = low + (high - low) * bin / bins;
        const double right = low + (high - low) * (bin + 1) / bins;
        const auto inside = std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap >= left && gap < right; });
        const double share = static_cast<double>(inside) / static_cast<double>(gaps.size());
        distance += 0.5 * std::abs(share - examples::boltzmann_integral(potential, left, right) / all);
    }
    std::printf("total variation %.4f\n", distance);
    EXPECT_LT(distance, 0.01);
}

TEST(BrownianPhysics, StabilisedSuspensionHasItsHeterogeneity) {
    // Schenker et al. 2012: 0.265 for their stabilised suspension; Brownian dynamics at 50 mV: 0.265 (N = 8000).
    SuspensionOptions suspension;
    suspension.volume_fraction = 0.4;
    suspension.radii = Eigen::VectorXd::Constant(2000, radius);
    BrownianOptions options;
    const double tau = examples::diffusion_time();
    options.stop_time = 0.5 * tau;
    options.sample_interval = options.stop_time;
    for (int time = 0; time < 8; ++time) {
        options.snapshot_times.push_back((0.15 + 0.05 * time) * tau);
    }
    const BrownianRun run = simulate_brownian(place_suspension(suspension), dlvo(0.05), options);
    double mean = 0;
    for (const Snapshot& snapshot : run.snapshots) {
        const Packing packing{run.packing.cell, snapshot.positions, run.packing.radii};
        mean += characterize::fit_degree_of_heterogeneity(characterize::measure_pores(packing), radius).a /
                static_cast<double>(run.snapshots.size());
    }
    std::printf("a = %.4f\n", mean);
    EXPECT_EQ(run.coordination, 0);
    EXPECT_NEAR(mean, 0.265, 0.005);
}

TEST(BrownianPhysics, ContactsRestAtTheirGapAndTemperature) {
    for (const double surface_potential : {0.0, 0.015}) {
        const PairPotential potential = dlvo(surface_potential);
        // Ten steps apart at 0 mV: from one step to the next the gap keeps nine tenths.
        const std::vector<double> gaps = watch_pairs(potential, 12, 0.004, {}, 30, 2e-4);
        double mean = 0;
        for (const double gap : gaps) {
            mean += gap / static_cast<double>(gaps.size());
        }
        double variance = 0;
        for (const double gap : gaps) {
            variance += (gap - mean) * (gap - mean) / static_cast<double>(gaps.size() - 1);
        }
        const auto average = [&](const std::function<double(double)>& weight) {
            return examples::boltzmann_integral(potential, -0.01, 0.018, weight) /
                   examples::boltzmann_integral(potential, -0.01, 0.018);
        };
        const double exact_mean = average([](double gap) { return gap; });
        const double exact_variance = average([&](double gap) { return (gap - exact_mean) * (gap - exact_mean); });
        std::printf("mean gap %.6f (exact %.6f), variance over exact %.4f\n", mean, exact_mean, variance / exact_variance);
        EXPECT_NEAR(exact_mean, 0.004, 1e-5);
        EXPECT_NEAR(mean, exact_mean, 5e-5);
        EXPECT_NEAR(variance / exact_variance, 1, 0.03);
    }
}

TEST(BrownianPhysics, BarrierIsPassedAtTheRightRate) {
    const PairPotential potential = dlvo(0.015);
    const double barrier = potential.barrier(radius)->gap / radius;
    // From well outside, where the error of the time step is largest.
    constexpr double time = 0.004;
    constexpr double start_gap = 0.06;
    const double exact = examples::share_inside(potential, start_gap, barrier, time);
    const Packing start = examples::lattice_of_pairs(32, [](int) { return start_gap; });
    BrownianOptions options;
    options.stop_time = time * examples::diffusion_time();
    options.sample_interval = options.stop_time;
    const BrownianRun run = simulate_brownian(start, potential, options);
    const std::vector<double> gaps = examples::gaps_of(start.cell, run.packing.positions);
    const auto inside = std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap < barrier; });
    const double share = static_cast<double>(inside) / static_cast<double>(gaps.size());
    std::printf("%.4f of the pairs inside the barrier, exact %.4f; time step %.2e R^2/D, %d stages, %s\n", share, exact,
                run.time_step.time_step / run.time_step.diffusion_time, run.time_step.stages, run.time_step.reason.c_str());
    EXPECT_NEAR(share / exact, 1, 0.05);
    EXPECT_EQ(run.time_step.reason, "the barrier");
}

}  // namespace
}  // namespace coagula::generators
