// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds under Brownian motion have their Boltzmann variance, however stiff they are and however many stages the steps have. Units
// in the names: mean radius, kB T, R^2/D.
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <Eigen/Core>

#include <cstdio>
#include <numbers>
#include <vector>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;

constexpr double rest_gap = 0.004;

struct Moments {
    double mean;
    double variance;
};

Moments boltzmann_moments(const PairPotential& potential) {
    const auto average = [&](const std::function<double(double)>& weight) {
        return examples::boltzmann_integral(potential, -0.01, 0.018, weight) /
               examples::boltzmann_integral(potential, -0.01, 0.018);
    };
    const double mean = average([](double gap) { return gap; });
    return {mean, average([&](double gap) { return (gap - mean) * (gap - mean); })};
}

/// A run that keeps the positions at so many times, ten steps apart, after a hundred steps.
BrownianRun watch(const Packing& start, const PairPotential& potential, double time_step, int times) {
    constexpr int between = 10;
    BrownianOptions options;
    options.time_step = time_step * examples::diffusion_time();
    options.stop_time = between * (times + 10) * options.time_step;
    options.sample_interval = options.stop_time;
    for (int time = 0; time < times; ++time) {
        options.snapshot_times.push_back(between * (10 + time) * options.time_step);
    }
    return simulate_brownian(start, potential, options);
}

/// What a run takes by itself, or an option sets.
struct Case {
    double stiffness;  ///< of the contact
    double time_step;
    int stages;
};

TEST(BrownianBonds, PairsHaveTheirVarianceWithEveryNumberOfStages) {
    // Of isolated pairs, whose gap relaxes with the rate 2 stiffness. The steps are those that a run takes by itself with the usual
    // stiffness and with 4, 10 and 40 times as much; where the rate is such that a step keeps all of the gap and adds no noise but
    // for the damping (rate times step s^2 (1 - cos(pi/s))); and the longest that is stable.
    const double rate = 2 * 4e5;
    const std::vector<Case> cases = {{4e5, 2e-5, 6},
                                     {4 * 4e5, 2e-5, 12},
                                     {10 * 4e5, 2e-5, 19},
                                     {40 * 4e5, 6.8e-6, 22},
                                     {4e5, 16 * (1 - std::numbers::sqrt2 / 2) / rate, 4},
                                     {40 * 4e5, 1.35e-5, 30}};
    for (const auto& [stiffness, time_step, stages] : cases) {
        const PairPotential potential = dlvo(0, {}, stiffness);
        const Packing start = examples::lattice_of_pairs(11, [](int) { return rest_gap; });
        const BrownianRun run = watch(start, potential, time_step, 60);
        EXPECT_EQ(run.time_step.stages, stages);
        Eigen::ArrayXd gaps(0);
        for (const Snapshot& snapshot : run.snapshots) {
            const std::vector<double> more = examples::gaps_of(start.cell, snapshot.positions);
            gaps.conservativeResize(gaps.size() + static_cast<Index>(more.size()));
            gaps.tail(static_cast<Index>(more.size())) = Eigen::ArrayXd::Map(more.data(), static_cast<Index>(more.size()));
        }
        const Moments exact = boltzmann_moments(potential);
        const double variance = (gaps - gaps.mean()).square().mean();
        std::printf("stiffness %.1e, %2d stages: mean off by %.3f deviations, variance over exact %.4f\n", stiffness,
                    run.time_step.stages, (gaps.mean() - exact.mean) / std::sqrt(exact.variance), variance / exact.variance);
        EXPECT_NEAR(variance / exact.variance, 1, 0.03);
        EXPECT_NEAR(gaps.mean(), exact.mean, 0.2 * std::sqrt(exact.variance));
    }
}

constexpr int beads = 10;

/// Straight chains along x, side by side.
Packing straight_chains(int side) {
    constexpr double length = 2.0 * beads + 6;
    constexpr double spacing = 6;
    const Index particles = Index{beads} * side * side;
    Packing packing{Cell::periodic(radius * Eigen::Vector3d(length, spacing * side, spacing * side)),
                    Eigen::Matrix3Xd(3, particles), Eigen::VectorXd::Constant(particles, radius)};
    for (int bead = 0; bead < packing.size(); ++bead) {
        const int chain = bead / beads;
        const int row = chain / side;
        packing.positions.col(bead) =
            radius * Eigen::Vector3d(3 + (2 + rest_gap) * (bead % beads), spacing * (chain % side + 0.5), spacing * (row + 0.5));
    }
    return packing;
}

TEST(BrownianBonds, EveryModeOfAChainHasItsVariance) {
    // The gaps of a chain that bends freely are independent, each with the distribution of a pair, so every combination of them has
    // the same variance. Those by sin(mode pi gap/n) are the modes of the straight chain, which relax with rates from 0.1 to 3.9
    // times the stiffness.
    constexpr int bonds = beads - 1;
    Eigen::MatrixXd shapes(bonds, bonds);
    for (int mode = 0; mode < bonds; ++mode) {
        for (int bond = 0; bond < bonds; ++bond) {
            shapes(mode, bond) = std::sqrt(2.0 / beads) * std::sin(std::numbers::pi * (mode + 1) * (bond + 1) / beads);
        }
    }
    const Packing start = straight_chains(24);
    for (const double factor : {1.0, 10.0}) {
        const PairPotential potential = dlvo(0, {}, factor * 4e5);
        const Moments exact = boltzmann_moments(potential);
        const BrownianRun run = watch(start, potential, 2e-5, 60);
        Eigen::VectorXd squares = Eigen::VectorXd::Zero(bonds);
        Eigen::VectorXd gaps(bonds);
        Index count = 0;
        for (const Snapshot& snapshot : run.snapshots) {
            for (Index first = 0; first < start.size(); first += beads) {
                for (Index bond = 0; bond < bonds; ++bond) {
                    const auto& at = snapshot.positions;
                    const double way = start.cell.minimum_image(at.col(first + bond + 1) - at.col(first + bond)).norm();
                    gaps[bond] = way / radius - 2 - exact.mean;
                }
                squares += (shapes * gaps).cwiseAbs2();
                ++count;
            }
        }
        squares /= static_cast<double>(count) * exact.variance;
        std::printf("%d stages, variance of the modes over exact:", run.time_step.stages);
        for (const double ratio : squares) {
            std::printf(" %.3f", ratio);
            EXPECT_NEAR(ratio, 1, 0.03) << run.time_step.stages << " stages";
        }
        std::printf("\n");
    }
}

}  // namespace
}  // namespace coagula::generators
