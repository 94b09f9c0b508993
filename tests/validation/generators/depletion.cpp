// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian particles that a polymer attracts: pairs have Boltzmann's distribution and fall into the well at the right rate, weak
// attraction leaves a suspension as it is, and strong attraction makes a gel. Units in the names: mean radius, kB T, R^2/D.
#include <coagula/generators/coagulation.hpp>
#include <coagula/generators/depletion.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>
#include <vector>

namespace coagula::generators {
namespace {

using examples::radius;
using examples::thermal;

constexpr double rest_gap = 0.004;

PairPotential attraction(double depth, double range, std::vector<PairLaw> others = {}) {
    return depletion_potential(
        {.depth = depth * thermal, .range = range * radius, .rest_gap = rest_gap * radius, .contact_stiffness = {}},
        std::move(others));
}

/// Holds the pairs: nothing up to 0.4 radii, 30 kB T higher at 0.7.
TabulatedLaw fence() {
    std::vector<double> gaps;
    std::vector<double> energies;
    for (int row = -10; row <= 80; ++row) {  // level at the end, where a kink would ask for short steps
        const double way = std::clamp((0.01 * row - 0.4) / 0.3, 0.0, 1.0);
        gaps.push_back(0.01 * row * radius);
        energies.push_back(30 * thermal * way * way * (3 - 2 * way));
    }
    return {gaps, energies};
}

BrownianRun watch(const Packing& start, const PairPotential& potential, double warm, double interval, int times) {
    const double tau = examples::diffusion_time();
    BrownianOptions options;
    options.stop_time = (warm + interval * times) * tau;
    options.sample_interval = options.stop_time;
    for (int time = 0; time < times; ++time) {
        options.snapshot_times.push_back((warm + interval * time) * tau);
    }
    return simulate_brownian(start, potential, options);
}

std::vector<double> gaps_of(const Packing& start, const BrownianRun& run) {
    std::vector<double> gaps;
    for (const Snapshot& snapshot : run.snapshots) {
        const std::vector<double> more = examples::gaps_of(start.cell, snapshot.positions);
        gaps.insert(gaps.end(), more.begin(), more.end());
    }
    return gaps;
}

double share_between(const std::vector<double>& gaps, double low, double high) {
    const auto inside = std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return gap >= low && gap < high; });
    return static_cast<double>(inside) / static_cast<double>(gaps.size());
}

TEST(BrownianDepletion, PairsHaveTheirBoltzmannDistribution) {
    // Bound and free ones, which change places within 0.1 R^2/D.
    for (const auto& [depth, range] : {std::pair(4.0, 0.2), std::pair(5.0, 0.1)}) {
        const PairPotential potential = attraction(depth, range, {fence()});
        const Packing start = examples::lattice_of_pairs(9, [&](int pair) { return pair % 2 == 0 ? rest_gap : 0.3; });
        const BrownianRun run = watch(start, potential, 0.1, 0.005, 30);
        const std::vector<double> gaps = gaps_of(start, run);
        const double all = examples::boltzmann_integral(potential, -0.1, 0.7);
        const std::vector<double> edges = {-0.1, -0.01, 0.0, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.3, 0.7};
        double distance = 0;
        for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin) {
            const double exact = examples::boltzmann_integral(potential, edges[bin], edges[bin + 1]) / all;
            distance += 0.5 * std::abs(share_between(gaps, edges[bin], edges[bin + 1]) - exact);
        }
        const double bound = share_between(gaps, -0.1, range);
        const double exact_bound = examples::boltzmann_integral(potential, -0.1, range) / all;
        std::printf("%g kT, range %g: bound %.4f (exact %.4f), total variation %.4f; %s\n", depth, range, bound, exact_bound,
                    distance, run.time_step.reason.c_str());
        EXPECT_NEAR(bound, exact_bound, 0.03);
        EXPECT_LT(distance, 0.03);
    }
}

TEST(BrownianDepletion, BoundPairsHaveTheVarianceOfTheirThermalStiffness) {
    // Up to the gap where the attraction has a tenth of its depth, which few pairs pass in the time of the run.
    constexpr double farthest = 0.1;
    const PairPotential potential = attraction(12, 0.2);
    const Packing start = examples::lattice_of_pairs(11, [](int) { return rest_gap; });
    std::vector<double> gaps = gaps_of(start, watch(start, potential, 2e-3, 2e-4, 60));
    std::erase_if(gaps, [](double gap) { return gap > farthest; });
    double mean = 0;
    double square = 0;
    for (const double gap : gaps) {
        mean += gap / static_cast<double>(gaps.size());
        square += gap * gap / static_cast<double>(gaps.size());
    }
    const BoundPair bond = bound_pair(potential, radius, examples::temperature, farthest * radius);
    const double exact = thermal / bond.thermal_stiffness / (radius * radius);
    std::printf("variance over exact %.4f; thermal stiffness over curvature %.3f\n", (square - mean * mean) / exact,
                bond.thermal_stiffness / bond.stiffness);
    EXPECT_NEAR((square - mean * mean) / exact, 1, 0.03);
}

TEST(BrownianDepletion, PairsFallIntoTheWellAtTheRightRate) {
    for (const auto& [range, start_gap, time] : {std::tuple(0.2, 0.1, 0.001), std::tuple(0.1, 0.05, 0.00025)}) {
        const PairPotential potential = attraction(10, range);
        const double inside = range / 4;
        const double exact = examples::share_inside(potential, start_gap, inside, time, -0.07);
        const Packing start = examples::lattice_of_pairs(28, [gap = start_gap](int) { return gap; });
        BrownianOptions options;
        options.stop_time = time * examples::diffusion_time();
        options.sample_interval = options.stop_time;
        const BrownianRun run = simulate_brownian(start, potential, options);
        const double share = share_between(examples::gaps_of(start.cell, run.packing.positions), -1, inside);
        std::printf("range %g: %.4f of the pairs in the well, exact %.4f; time step %.2e R^2/D, %d stages, %s\n", range, share,
                    exact, run.time_step.time_step / run.time_step.diffusion_time, run.time_step.stages,
                    run.time_step.reason.c_str());
        EXPECT_NEAR(share / exact, 1, 0.05);
    }
}

TEST(BrownianDepletion, OneThermalEnergyLeavesASuspensionAndTenMakeAGel) {
    constexpr Index particles = 500;
    constexpr double range = 0.2;
    for (const double depth : {1.0, 10.0}) {
        const PairPotential potential = attraction(depth, range);
        SuspensionOptions suspension;
        suspension.volume_fraction = 0.2;
        suspension.radii = Eigen::VectorXd::Constant(particles, radius);
        BrownianOptions options;
        options.cutoff_gap = 0.4 * radius;
        options.contact_tolerance = (rest_gap + range) / 2;
        options.stop_time = 0.3 * examples::diffusion_time();
        const BrownianRun run = simulate_brownian(place_suspension(suspension), potential, options);
        std::printf("%g kT: coordination %.3f, largest cluster %ld, axes %ld\n", depth, run.coordination,
                    static_cast<long>(run.series.largest.back()), static_cast<long>(run.series.percolating.back()));
        if (depth < 5) {
            EXPECT_LT(run.coordination, 1.5);
            EXPECT_LT(run.series.largest.back(), particles / 4);
            EXPECT_EQ(run.series.percolating.back(), 0);
        } else {
            EXPECT_GT(run.coordination, 3);
            EXPECT_GT(run.series.largest.back(), 9 * particles / 10);
            EXPECT_EQ(run.series.percolating.back(), 3);
        }
    }
}

}  // namespace
}  // namespace coagula::generators
