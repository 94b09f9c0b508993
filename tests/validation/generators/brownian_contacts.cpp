// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that resist sliding and rolling, and weight, against closed forms. Units in the names: mean radius, kB T, R^2/D.
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <Eigen/Geometry>

#include <cstdio>
#include <numbers>
#include <numeric>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;
using examples::thermal;

constexpr double rest_gap = 0.004;
constexpr double stiffness_unit = thermal / (radius * radius);

ContactResistance resistance(double tangential, double rolling = unset) {
    return {.tangential_stiffness = tangential * stiffness_unit, .rolling_stiffness = rolling * stiffness_unit};
}

/// A run with snapshots at equal intervals, in R^2/D.
BrownianRun watch(const Packing& start, BrownianOptions options, double interval, int times, double surface_potential = 0) {
    const double tau = examples::diffusion_time();
    options.stop_time = times * interval * tau;
    options.sample_interval = interval * tau;
    for (int time = 0; time < times; ++time) {
        options.snapshot_times.push_back(time * interval * tau);
    }
    return simulate_brownian(start, dlvo(surface_potential), options);
}

Sedimentation settling(double weight) {
    const double volume = 4 * std::numbers::pi / 3 * radius * radius * radius;
    return {.gravity = 9.81, .density_difference = weight * thermal / radius / volume / 9.81};
}

/// Of a series, without its first half.
double late_mean(const std::vector<double>& values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    return std::accumulate(half, values.end(), 0.0) / static_cast<double>(values.end() - half);
}

TEST(BrownianContacts, TangentialAndRollingModesHaveTheirEnergy) {
    constexpr int side = 12;
    const Packing start = examples::lattice_of_pairs(side, [](int) { return rest_gap; });
    BrownianOptions options;
    options.resistance = resistance(1e5, 2e5);
    const BrownianRun run = watch(start, options, 6e-5, 80);
    // Two directions of kB T/2 each.
    const double sliding = late_mean(run.series.sliding_energy) / (side * side * side * thermal);
    const double rolling = late_mean(run.series.rolling_energy) / (side * side * side * thermal);
    std::printf("energy over kB T: sliding %.4f, rolling %.4f\n", sliding, rolling);
    EXPECT_NEAR(sliding, 1, 0.02);
    EXPECT_NEAR(rolling, 1, 0.02);
}

/// Rotational diffusion coefficient of the axes of pairs: <n(0).n(t)> = exp(-2 D t).
double diffusion_of_axes(const BrownianOptions& options, double interval, int times) {
    const Packing start = examples::lattice_of_pairs(12, [](int) { return rest_gap; });
    const BrownianRun run = watch(start, options, interval, times);
    double sum = 0;
    Index count = 0;
    for (std::size_t time = 1; time < run.snapshots.size(); ++time) {
        for (Index first = 0; first < start.size(); first += 2) {
            const auto axis = [&](const Snapshot& at) {
                return start.cell.minimum_image(at.positions.col(first + 1) - at.positions.col(first)).normalized().eval();
            };
            sum += axis(run.snapshots[time - 1]).dot(axis(run.snapshots[time]));
            ++count;
        }
    }
    return -std::log(sum / static_cast<double>(count)) / (2 * interval);
}

TEST(BrownianContacts, SlipByThermalMotionCoolsSlidingAndLeavesTheNormalMode) {
    // Coulomb's slip loses energy without a noise of its own, so what the spring holds is below equipartition: it cannot be more
    // than at the limit of friction, a fifth of kB T here. The gap has its Boltzmann variance all the same.
    constexpr int side = 12;
    constexpr double tangential = 1e5;
    constexpr double most = 0.2;
    const PairPotential potential = dlvo(0);
    const double normal_force = potential.contact().stiffness / stiffness_unit * (potential.cut_gap() / radius - rest_gap);
    const Packing start = examples::lattice_of_pairs(side, [](int) { return rest_gap; });
    BrownianOptions options;
    options.resistance = resistance(tangential);
    options.resistance.friction = std::sqrt(2 * tangential * most) / normal_force;
    const BrownianRun run = watch(start, options, 6e-5, 80);
    const double sliding = late_mean(run.series.sliding_energy) / (side * side * side * thermal);
    std::vector<double> gaps;
    for (std::size_t time = 20; time < run.snapshots.size(); ++time) {
        const std::vector<double> more = examples::gaps_of(start.cell, run.snapshots[time].positions);
        gaps.insert(gaps.end(), more.begin(), more.end());
    }
    const auto count = static_cast<double>(gaps.size());
    const double mean = std::accumulate(gaps.begin(), gaps.end(), 0.0) / count;
    const double variance =
        std::accumulate(gaps.begin(), gaps.end(), 0.0, [&](double sum, double gap) { return sum + (gap - mean) * (gap - mean); }) /
        count;
    const auto average = [&](const std::function<double(double)>& weight) {
        return examples::boltzmann_integral(potential, -0.01, 0.018, weight) /
               examples::boltzmann_integral(potential, -0.01, 0.018);
    };
    const double exact_mean = average([](double gap) { return gap; });
    const double exact = average([&](double gap) { return (gap - exact_mean) * (gap - exact_mean); });
    std::printf("sliding energy over kB T %.4f, at most %.1f; variance of gaps over exact %.4f\n", sliding, most, variance / exact);
    EXPECT_LT(sliding, most * 1.1);  // the normal force, and its square more, fluctuates about that at rest
    EXPECT_GT(sliding, 0.5 * most);
    EXPECT_NEAR(variance / exact, 1, 0.03);
}

TEST(BrownianContacts, PairThatSlidesAndPairThatRolls) {
    // Two centres at a distance r: relative mobility 2 along the tangent. Where the surfaces must not slide, the friction turns
    // both spheres (mobility 3/4, lever r/2): the mobility 2 of the centres becomes 2 s/(2 + s), s = 2 (3/4) (r/2)^2, about 3/7 of
    // it.
    constexpr double distance = 2 + rest_gap;
    constexpr double turning = 1.5 * distance * distance / 4;
    const double slides = 2 / (distance * distance);
    const double rolls = 2 * turning / (2 + turning) / (distance * distance);
    const double free = diffusion_of_axes({}, 0.005, 8);
    BrownianOptions options;
    options.resistance = resistance(2e5);
    const double sticking = diffusion_of_axes(options, 0.005, 8);
    options.resistance.friction = 0;
    const double slipping = diffusion_of_axes(options, 0.005, 8);
    std::printf("slides %.4f, slips %.4f (exact %.4f); rolls %.4f (exact %.4f)\n", free, slipping, slides, sticking, rolls);
    EXPECT_NEAR(free / slides, 1, 0.03);
    EXPECT_NEAR(slipping / slides, 1, 0.03);
    EXPECT_NEAR(sticking / rolls, 1, 0.03);
}

/// Straight chains of three on a lattice.
Packing chains(int side) {
    constexpr double spacing = 9;
    const Index particles = Index{3} * side * side * side;
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(spacing * side * radius)), Eigen::Matrix3Xd(3, particles),
                    Eigen::VectorXd::Constant(particles, radius)};
    for (int chain = 0; chain < side * side * side; ++chain) {
        const Eigen::Array3i place(chain % side, chain / side % side, chain / side / side);
        const Eigen::Vector3d centre = spacing * (place.cast<double>() + 0.5).matrix();
        const Eigen::Vector3d axis = random_normal(7, RandomPurpose::test, 0, static_cast<std::uint64_t>(chain)).normalized();
        for (int bead = 0; bead < 3; ++bead) {
            packing.positions.col(3 * chain + bead) = radius * (centre + (bead - 1) * (2 + rest_gap) * axis);
        }
    }
    return packing;
}

TEST(BrownianContacts, ChainOfThreeBendsAsItsContactsRoll) {
    // The middle at y off the line of the ends: both contacts slide by y - l t and roll by t, where l is the lever and t the turn
    // of the outer spheres. With the best t the energy is y^2 k_t k_r/(k_t l^2 + k_r), k_r the moment per angle.
    constexpr int side = 8;
    constexpr double tangential = 1e5;
    constexpr double rolling = 4e4;
    const Packing start = chains(side);
    BrownianOptions options;
    options.resistance = resistance(tangential, rolling);
    const BrownianRun run = watch(start, options, 2e-4, 80);
    double sum = 0;
    int count = 0;
    for (std::size_t time = 10; time < run.snapshots.size(); ++time) {
        for (Index first = 0; first < start.size(); first += 3) {
            const auto from_middle = [&](Index bead) {
                const auto& at = run.snapshots[time].positions;
                return Eigen::Vector3d(start.cell.minimum_image(at.col(first + bead) - at.col(first + 1)) / radius);
            };
            const Eigen::Vector3d one = from_middle(0);
            const Eigen::Vector3d other = from_middle(2);
            const Eigen::Vector3d axis = (other - one).normalized();
            const Eigen::Vector3d offset = 0.5 * (one + other);
            sum += (offset - axis.dot(offset) * axis).squaredNorm();
            ++count;
        }
    }
    const double lever = 1 + rest_gap / 2;
    const double moment = rolling / 4;  // at the reduced radius 1/2
    const double stiffness = 2 * tangential * moment / (tangential * lever * lever + moment);
    std::printf("mean square offset over exact %.4f\n", sum / count * stiffness / 2);
    EXPECT_NEAR(sum / count * stiffness / 2, 1, 0.03);
}

/// Pairs of unequal spheres side by side along x, the first the larger and higher by `lead` radii.
Packing unequal_pairs(int side, double large, double small, double lead) {
    Packing packing = examples::lattice_of_pairs(side, [](int) { return 0.0; });
    const double distance = large + small + rest_gap;
    const Eigen::Vector3d axis(std::sqrt(distance * distance - lead * lead) / distance, 0, lead / distance);
    for (Index first = 0; first < packing.size(); first += 2) {
        const Eigen::Vector3d apart = packing.cell.minimum_image(packing.positions.col(first) - packing.positions.col(first + 1));
        const Eigen::Vector3d middle = packing.positions.col(first) - 0.5 * apart;
        packing.positions.col(first) = middle + (large + rest_gap / 2) * radius * axis;
        packing.positions.col(first + 1) = middle - (small + rest_gap / 2) * radius * axis;
        packing.radii[first] = large * radius;
        packing.radii[first + 1] = small * radius;
    }
    return packing;
}

/// The speed at which heavy spheres settle past light ones of radius 2 - heavy, in the middle of which they are side by side.
/// @param expected about this speed.
double settling_difference(const BrownianOptions& options, double heavy, double expected) {
    constexpr double interval = 8e-6;
    const Packing start = unequal_pairs(12, heavy, 2 - heavy, 2.5 * interval * expected);
    const BrownianRun run = watch(start, options, interval, 3);
    const auto offset = [&](const Eigen::Matrix3Xd& positions) {
        double sum = 0;
        for (Index first = 0; first < start.size(); first += 2) {
            sum += run.packing.cell.minimum_image(positions.col(first + 1) - positions.col(first))[2];
        }
        return 2 * sum / static_cast<double>(start.size()) / radius;
    };
    return (offset(run.packing.positions) - offset(run.snapshots[2].positions)) / interval;
}

/// Mean elastic force of a contact that is driven by a force and slips beyond a longest displacement: a Boltzmann distribution on a
/// disc with a reflecting rim.
double mean_friction(double stiffness, double drive, double longest) {
    constexpr int rings = 400;
    constexpr int sectors = 400;
    double weights = 0;
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const double distance = longest * (ring + 0.5) / rings;
        for (int sector = 0; sector < sectors; ++sector) {
            const double along = distance * std::cos(2 * std::numbers::pi * sector / sectors);
            const double rest = drive / stiffness - along;
            const double across = distance * distance - along * along;
            const double weight =
                distance * std::exp(-0.5 * stiffness * (rest * rest + across - std::pow(drive / stiffness - longest, 2)));
            weights += weight;
            sum += weight * stiffness * along;
        }
    }
    return sum / weights;
}

TEST(BrownianContacts, HeavySphereSlidesDownALightOneAsFrictionLets) {
    constexpr double large = 1.3;
    constexpr double small = 0.7;
    constexpr double weight = 8000;
    constexpr double tangential = 1e5;
    BrownianOptions options;
    options.sedimentation = settling(weight);
    options.time_step = 2e-8 * examples::diffusion_time();
    // Settling speeds are weight over 1/mobility: R^3 / R. Surfaces that stick leave 3/7 of the difference, as above.
    const double difference = weight * (large * large - small * small);
    const double mobility = 1 / large + 1 / small;
    EXPECT_NEAR(settling_difference(options, large, difference) / difference, 1, 0.02);
    options.resistance = resistance(tangential);
    const double rolling = difference * 3 / 7;
    EXPECT_NEAR(settling_difference(options, large, rolling) / rolling, 1, 0.02);
    // Friction against the elastic force of the contact, which is the attraction: nothing presses pairs that lie side by side.
    options.resistance.friction = 0.4;
    const PairPotential potential = dlvo(0);
    const double scale = 2 * large * small / (large + small);
    const double attraction = -potential.force(potential.cut_gap()) * radius / thermal * scale;
    const double limit = options.resistance.friction * attraction;
    const double friction = mean_friction(scale * tangential, difference / (1.75 * mobility), limit / (scale * tangential));
    const double slipping = difference - mobility * friction;
    const double measured = settling_difference(options, large, slipping);
    std::printf("limit %.0f, mean friction %.0f; speed slipping %.0f, exact %.0f, free %.0f, rolling %.0f\n", limit, friction,
                measured, slipping, difference, rolling);
    EXPECT_NEAR((difference - measured) / (mobility * friction), 1, 0.04);
}

TEST(BrownianContacts, SettledParticlesHaveTheirBarometricHeight) {
    // Single spheres over a floor, far from each other.
    constexpr int side = 24;
    constexpr double spacing = 5;
    constexpr double weight = 50;
    constexpr Index particles = Index{side} * side;
    Packing start{Cell::periodic(radius * Eigen::Vector3d(spacing * side, spacing * side, 12)), Eigen::Matrix3Xd(3, particles),
                  Eigen::VectorXd::Constant(particles, radius)};
    for (int particle = 0; particle < particles; ++particle) {
        const int row = particle / side;
        start.positions.col(particle) =
            radius * Eigen::Vector3d(spacing * (particle % side + 0.5), spacing * (row + 0.5), 1 / weight);
    }
    BrownianOptions options;
    options.sedimentation = settling(weight);
    options.time_step = 4e-6 * examples::diffusion_time();
    const BrownianRun run = watch(start, options, 2e-3, 30, 0.05);
    double sum = 0;
    double most = 0;
    int count = 0;
    for (std::size_t time = 10; time < run.snapshots.size(); ++time) {
        for (Index particle = 0; particle < start.size(); ++particle) {
            const double height = run.snapshots[time].positions(2, particle) / radius - 1;
            sum += height;
            most += height > 2 / weight ? 1 : 0;
            ++count;
        }
    }
    // Boltzmann: exp(-weight h) above the floor, a Gaussian of the elastic wall below.
    constexpr double stiffness = 4e5;
    const double partition = 1 / weight + std::sqrt(std::numbers::pi / 2 / stiffness);
    const double exact = (1 / (weight * weight) - 1 / stiffness) / partition;
    const double exact_share = std::exp(-2) / weight / partition;
    std::printf("mean height %.5f (exact %.5f), share above 2/weight %.4f (exact %.4f)\n", sum / count, exact, most / count,
                exact_share);
    EXPECT_NEAR(sum / count / exact, 1, 0.03);
    EXPECT_NEAR(most / count, exact_share, 0.006);
}

}  // namespace
}  // namespace coagula::generators
