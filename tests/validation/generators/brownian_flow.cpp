// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian particles in a shear flow against closed forms. Units in the names: mean radius, kB T, R^2/D.
#include <coagula/generators/brownian_dynamics.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"

#include <cstdio>
#include <numbers>

namespace coagula::generators {
namespace {

using examples::dlvo;
using examples::radius;
using examples::thermal;

constexpr double rest_gap = 0.004;
constexpr double cold = 1e-7;  // [K]: what moves moves by force, not by heat

/// Single spheres on a cubic lattice.
Packing lattice(int side, double spacing) {
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(spacing * side * radius)),
                    Eigen::Matrix3Xd(3, Index{side} * side * side), Eigen::VectorXd::Constant(Index{side} * side * side, radius)};
    for (int particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Array3i place(particle % side, particle / side % side, particle / side / side);
        packing.positions.col(particle) = spacing * radius * (place.cast<double>() + 0.5).matrix();
    }
    return packing;
}

TEST(BrownianFlow, FreeParticlesFollowTheFlowAndDiffuse) {
    // Beyond the flow of where it began a particle moves by a normal displacement: along the gradient 2 D t, along the flow
    // 2 D t (1 + (rate t)^2 / 3), for it drifts through layers of other speeds, and their covariance is rate D t^2.
    constexpr double duration = 0.05;  // R^2/D
    constexpr double strain = 2.2;     // the box leans by more than its length
    const Packing start = lattice(20, 5);
    const double tau = examples::diffusion_time();
    BrownianOptions options;
    options.stop_time = duration * tau;
    options.sample_interval = options.stop_time;
    options.flow.rate = strain / options.stop_time;
    const BrownianRun run = simulate_brownian(start, dlvo(0.05), options);
    const double width = start.cell.lengths()[0];
    EXPECT_NEAR(run.packing.cell.edges()(0, 2), (strain - 2) * width, 1e-9 * width);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (Index particle = 0; particle < start.size(); ++particle) {
        Eigen::Vector3d carried = start.positions.col(particle);
        carried[0] += strain * carried[2];
        const Eigen::Vector3d way = run.packing.cell.minimum_image(run.packing.positions.col(particle) - carried) / radius;
        sum += way;
        squares += way * way.transpose();
    }
    squares /= static_cast<double>(start.size());
    sum /= static_cast<double>(start.size());
    const double free = 2 * duration;
    const double along = free * (1 + strain * strain / 3);
    const double covariance = free * strain / 2;
    std::printf("mean squares over exact: flow %.4f, vorticity %.4f, gradient %.4f, covariance %.4f\n", squares(0, 0) / along,
                squares(1, 1) / free, squares(2, 2) / free, squares(0, 2) / covariance);
    // Standard errors: sqrt(2 / 8000) = 1.6 % of a mean square, a little more of the covariance.
    EXPECT_NEAR(squares(0, 0) / along, 1, 0.05);
    EXPECT_NEAR(squares(1, 1) / free, 1, 0.05);
    EXPECT_NEAR(squares(2, 2) / free, 1, 0.05);
    EXPECT_NEAR(squares(0, 2) / covariance, 1, 0.06);
    EXPECT_LT(sum.norm(), 4 * std::sqrt((along + 2 * free) / static_cast<double>(start.size())));
    // Hardly anything meets: the particles bear the pressure of an ideal gas.
    const double pressure = thermal * static_cast<double>(start.size()) / start.cell.volume();
    EXPECT_NEAR(run.series.stress.normal_stress_y.back() / -pressure, 1, 1e-4);
    EXPECT_LT(std::abs(run.series.stress.shear_stress.back()), 1e-4 * pressure);
}

/// Two bound spheres resist the flow that draws them apart: a tension of drag/2 x rate x distance x n_x n_z.
TEST(BrownianFlow, BoundPairsBearTheDragOfTheFlow) {
    Packing start = examples::lattice_of_pairs(8, [](int) { return rest_gap; });
    BrownianOptions options;
    options.temperature = cold;
    options.cutoff_gap = 0.3 * radius;
    const PairPotential potential = dlvo(0);
    options.time_step = choose_time_step(potential, radius, rest_gap * radius, options).time_step;
    options.stop_time = 200 * options.time_step;
    options.sample_interval = options.time_step;
    options.flow.rate = 0.99e-3 / options.time_step;
    const BrownianRun run = simulate_brownian(start, potential, options);
    const double drag = 6 * std::numbers::pi * options.viscosity * radius;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (Index first = 0; first < start.size(); first += 2) {
        const auto& at = run.packing.positions;
        const Eigen::Vector3d branch = run.packing.cell.minimum_image(at.col(first + 1) - at.col(first));
        const Eigen::Vector3d axis = branch.normalized();
        sum += 0.5 * drag * options.flow.rate * branch.squaredNorm() * axis[0] * axis[2] * axis * axis.transpose();
    }
    sum /= run.packing.cell.volume();
    const StressSeries& stress = run.series.stress;
    EXPECT_NEAR(stress.shear_stress.back() / sum(2, 0), 1, 1e-3);
    EXPECT_NEAR(stress.normal_stress_x.back() - stress.normal_stress_z.back(), sum(0, 0) - sum(2, 2), 2e-3 * sum(2, 0));
    EXPECT_EQ(stress.contact_shear_stress.back(), 0);
}

TEST(BrownianFlow, PairsAcrossTheFacesOfTheBoxAreLikeOthers) {
    // The same pairs shifted by half a box, so that others lie across its faces: the same stress and the same motion.
    const PairPotential potential = dlvo(0);
    BrownianOptions options;
    options.temperature = cold;
    options.cutoff_gap = 0.3 * radius;
    options.resistance = {.tangential_stiffness = 1e5 * thermal / (radius * radius),
                          .rolling_stiffness = 5e4 * thermal / (radius * radius)};
    options.time_step = choose_time_step(potential, radius, rest_gap * radius, options).time_step;
    options.stop_time = 300 * options.time_step;
    options.sample_interval = options.stop_time / 3;
    options.flow.rate = 1e-3 / options.time_step;
    Packing start = examples::lattice_of_pairs(6, [](int) { return rest_gap; });
    const BrownianRun inside = simulate_brownian(start, potential, options);
    for (Index particle = 0; particle < start.size(); ++particle) {
        start.positions.col(particle) = start.cell.wrap(start.positions.col(particle) + radius * Eigen::Vector3d(3.5, 3.5, 3.5));
    }
    const BrownianRun across = simulate_brownian(start, potential, options);
    for (std::size_t k = 1; k < inside.series.time.size(); ++k) {
        const double stress = inside.series.stress.shear_stress[k];
        EXPECT_NEAR(across.series.stress.shear_stress[k] / stress, 1, 1e-4);
        EXPECT_NEAR(across.series.stress.contact_shear_stress[k], inside.series.stress.contact_shear_stress[k], 1e-4 * stress);
        EXPECT_GT(std::abs(inside.series.stress.contact_shear_stress[k]), 1e-2 * stress);
    }
}

TEST(BrownianFlow, ViscosityAndModuliOfASeries) {
    // A stress that is known at every instant, averaged over the intervals of the samples.
    const ShearFlow steady{.rate = 20};
    std::vector<double> time;
    StressSeries stress;
    for (int k = 0; k <= 64; ++k) {
        time.push_back(0.1 * k);
        stress.shear_stress.push_back(k < 32 ? 1000 : 5 + (k % 2 == 0 ? 1 : -1));
        stress.normal_stress_x.push_back(-1);
        stress.normal_stress_z.push_back(-4);
    }
    const FlowResponse response = flow_response(steady, time, stress);
    EXPECT_NEAR(response.particle_viscosity, 0.25, 1e-12);
    EXPECT_NEAR(response.first_normal_difference, 3, 1e-12);
    EXPECT_NEAR(response.particle_viscosity_error, 0, 1e-12);
    EXPECT_EQ(response.blocks, 8);

    const ShearFlow oscillation{.amplitude = 0.1, .frequency = 2};
    const double angular = 4 * std::numbers::pi;
    stress.shear_stress = {0};
    time = {0};
    for (int k = 1; k <= 40; ++k) {
        const double before = time.back();
        time.push_back(0.05 * k);
        const auto integral = [&](double at) {  // of 3 strain + 0.5 (rate of strain over angular frequency) + 7
            return 0.1 * (-3 * std::cos(angular * at) + 0.5 * std::sin(angular * at)) / angular + 7 * at;
        };
        stress.shear_stress.push_back((integral(time.back()) - integral(before)) / (time.back() - before));
    }
    const FlowResponse moduli = flow_response(oscillation, time, stress);
    EXPECT_EQ(moduli.blocks, 2);
    EXPECT_NEAR(moduli.storage_modulus, 3, 1e-9);
    EXPECT_NEAR(moduli.loss_modulus, 0.5, 1e-9);
    EXPECT_NEAR(moduli.storage_modulus_error, 0, 1e-9);
}

TEST(BrownianFlow, RefusesWhatItCannotDo) {
    const Packing start = lattice(3, 6);
    const auto refused = [&](const ShearFlow& flow, const Packing& packing, double time_step = unset) {
        BrownianOptions options;
        options.stop_time = 1e-6;
        options.flow = flow;
        options.time_step = time_step;
        EXPECT_THROW(simulate_brownian(packing, dlvo(0.05), options), std::invalid_argument);
    };
    refused({.rate = 1, .amplitude = 0.1, .frequency = 1}, start);
    refused({.amplitude = 0.1}, start);
    refused({.amplitude = -0.1, .frequency = 1}, start);
    refused({.frequency = 1}, start);
    refused({.rate = 1e6}, start, 1e-6);
    Packing tilted = start;
    Eigen::Matrix3d edges = start.cell.edges();
    edges(1, 2) = 0.1 * edges(1, 1);
    tilted.cell = Cell::of_edges(Eigen::Vector3d::Zero(), edges, {true, true, true});
    refused({.rate = 1}, tilted);
}

}  // namespace
}  // namespace coagula::generators
