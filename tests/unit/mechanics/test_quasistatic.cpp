// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/quasistatic.hpp>

#include "curves/loop_analysis.hpp"
#include "networks.hpp"
#include "quasistatic/residual_minimisation.hpp"
#include "quasistatic_examples.hpp"

#include <coagula/mechanics/linear.hpp>

#include <omp.h>
#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coagula::mechanics {
namespace {

using std::numbers::pi;

using coagula::testing::random_spheres;
using quasistatic_examples::Columns;
using quasistatic_examples::gel;
using quasistatic_examples::radius;
using quasistatic_examples::springs;
using quasistatic_examples::stress_zx;
using quasistatic_examples::zx;

/// Springs that resist bending, so that no part of the network is floppy.
ContactModel stiff_joints() {
    ContactModel model = springs();
    model.bending_stiffness = 1e-2 * 50 * radius * radius;
    model.twisting_stiffness = model.bending_stiffness;
    return model;
}

TEST(LoopAnalysis, StraightLineAndParallelogramInClosedForm) {
    const int points = 64;
    std::vector<double> phase;
    std::vector<double> line;
    for (int k = 0; k <= points; ++k) {
        phase.push_back(2 * pi * k / points);
        line.push_back(7 * std::sin(phase.back()));
    }
    const Harmonics elastic = analyse_loop(0.5, phase, line);
    EXPECT_NEAR(elastic.in_phase, 7, 1e-12);
    EXPECT_NEAR(elastic.out_of_phase, 0, 1e-12);
    EXPECT_NEAR(elastic.third_over_first, 0, 1e-12);

    // Rigid and perfectly plastic: a square wave, with jumps at the turning points; harmonics 4/pi (cos x - cos 3x / 3 ...).
    const Harmonics plastic = analyse_loop(1, {0, pi / 2, pi / 2, 3 * pi / 2, 3 * pi / 2, 2 * pi}, {3, 3, -3, -3, 3, 3});
    EXPECT_NEAR(plastic.out_of_phase, 3 * 4 / pi, 1e-12);
    EXPECT_NEAR(plastic.in_phase, 0, 1e-12);
    EXPECT_NEAR(plastic.third_over_first, 1.0 / 3, 1e-12);
    EXPECT_NEAR(plastic.area, 12, 1e-12);
    EXPECT_EQ(analyse_loop(1, {0, 1, 2 * pi}, {0, 0, 0}).third_over_first, 0);
}

TEST(MinimiseResidual, SolvesUnsymmetricAndSingularSystems) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(12, 12) + 4 * Eigen::MatrixXd::Identity(12, 12);
    const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(12, -1, 2);
    const auto found =
        minimise_residual([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return matrix * x; }, matrix* wanted, 1e-13, 20);
    EXPECT_LT((found.solution - wanted).norm(), 1e-10);
    Eigen::Matrix3d singular = Eigen::Vector3d(2, 3, 0).asDiagonal();
    const auto part = minimise_residual([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return singular * x; },
                                        Eigen::Vector3d(2, 6, 0), 1e-13, 10);
    EXPECT_LT((part.solution - Eigen::Vector3d(1, 2, 0)).norm(), 1e-12);
}

TEST(Quasistatic, SmallStrainIsTheLinearResponse) {
    const auto sample = gel(500);
    const LinearResponse linear = solve_linear(sample.packing, sample.contacts);
    const auto moduli = small_strain_moduli(sample.packing, sample.contacts, springs(), 1e-6);
    const auto orientations = all_orientations();
    ASSERT_EQ(moduli.size(), orientations.size());
    for (std::size_t k = 0; k < moduli.size(); ++k) {
        EXPECT_NEAR(moduli[k] / linear.shear_modulus(orientations[k].normal, orientations[k].direction), 1, 1e-4);
    }
}

/// A chain across the cell turns and stretches: force k (sqrt(1 + g^2) - 1) L, whatever the shear springs do.
TEST(Quasistatic, ChainBreaksAtItsStrength) {
    const double length = 2 * radius;
    Columns chain({20 * radius, 20 * radius, length}, {radius});
    chain.join(0, {0, 0, length});
    ContactModel model = springs();
    model.normal_strength = 0.02 * 50 * length;
    const double breaks_at = std::sqrt(1.02 * 1.02 - 1);
    const auto ramp = shear_to(chain.packing, chain.bonds, model, {.strain = 0.3, .steps = 10, .solver = {.orientation = zx}});
    ASSERT_EQ(ramp.broken.size(), 1U);
    EXPECT_NEAR(ramp.broken[0].strain, breaks_at, 1e-8);
    EXPECT_EQ(ramp.broken[0].cause, BreakageCause::normal);
    EXPECT_FALSE(ramp.broken[0].follows);
    const double volume = chain.packing.cell.volume();
    for (const StrainPoint& point : ramp.points) {
        const double stretch = std::sqrt(1 + point.strain * point.strain);
        const double force = point.bonds == 1 ? 50 * length * (stretch - 1) : 0.0;
        EXPECT_NEAR(stress_zx(point), force * length * point.strain / stretch / volume,
                    1e-6 * model.normal_strength * length / volume);
    }
    EXPECT_NEAR(ramp.points.back().breakage / (0.5 * 50 * std::pow(0.02 * length, 2)), 1, 1e-8);
    EXPECT_EQ(ramp.points.back().stored, 0);
    EXPECT_EQ(ramp.points.back().bonds, 0);
    ASSERT_TRUE(ramp.failure);
    EXPECT_EQ(ramp.failure->strain, ramp.broken[0].strain);
    EXPECT_EQ(ramp.failure->broken, 1);
}

TEST(Quasistatic, TwoChainsOfUnequalLengthBreakOneAfterTheOther) {
    const double length = 2 * radius;
    Columns chains({20 * radius, 20 * radius, length}, {radius, 0.99 * radius});
    chains.join(0, {0, 0, length});
    chains.join(1, {0, 0, length});
    ContactModel model = springs();
    model.normal_strength = 0.03 * 50 * length;
    const auto strain_at = [&](double rest) { return std::sqrt(std::pow(rest / length + 0.03, 2) - 1); };
    const auto ramp = shear_to(chains.packing, chains.bonds, model,
                               {.strain = 0.4, .steps = 7, .solver = {.orientation = zx, .rest_length = RestLength::touching}});
    ASSERT_EQ(ramp.broken.size(), 2U);
    EXPECT_EQ(ramp.broken[0].bond, 1);
    EXPECT_NEAR(ramp.broken[0].strain, strain_at(2 * 0.99 * radius), 1e-8);
    EXPECT_EQ(ramp.broken[1].bond, 0);
    EXPECT_NEAR(ramp.broken[1].strain, strain_at(length), 1e-8);
    ASSERT_TRUE(ramp.failure) << "with the second chain, not with the first";
    EXPECT_EQ(ramp.failure->strain, ramp.broken[1].strain);
    EXPECT_EQ(ramp.points.back().strain, ramp.failure->strain);
    EXPECT_EQ(ramp.points.back().stress.norm(), 0);
}

/// Columns of touching spheres whose bonds to their neighbours along x resist rolling: the shear of the contact without bond and
/// that of the bond are in series, so the loop is a parallelogram of slope k_s d / 2 and height mu N.
TEST(Quasistatic, FrictionLoopOfAPairInClosedForm) {
    const double wide = 2 * radius;
    const double high = 2 * radius * (1 - 1e-6);
    Columns column({wide, 20 * radius, high}, {radius});
    column.join(0, {wide, 0, 0});
    ContactModel model = springs();
    model.friction = 0.5;
    const double limit = 0.5 * 50 * (2 * radius - high);
    const double slope = 0.5 * 5 * high;
    const double amplitude = 4 * limit / slope;
    const auto sweep =
        sweep_amplitudes(column.packing, column.bonds, model,
                         {.amplitudes = {amplitude}, .cycles = 2, .steps_per_cycle = 256, .solver = {.orientation = zx}});
    const AmplitudeResponse& loop = sweep.amplitudes.front();
    const double stress = limit * high / column.packing.cell.volume();
    const double area = 4 * stress * (amplitude - limit / slope);
    EXPECT_NEAR(loop.peak_stress / stress, 1, 1e-3);
    EXPECT_NEAR(loop.loop_area / area, 1, 1e-3);
    EXPECT_NEAR(loop.loss_modulus / (loop.loop_area / (pi * amplitude * amplitude)), 1, 1e-12);
    EXPECT_LT(loop.balance_error, 1e-6);
    EXPECT_NEAR((loop.loop.back().dissipated - loop.loop.front().dissipated) / (area * column.packing.cell.volume()), 1, 1e-3);
}

/// Hertzian bonds along the two diagonals: one is stretched by g L / sqrt 2, the other pressed as much; neither is sheared.
TEST(Quasistatic, HertzianModulusGrowsWithTheRootOfTheStrain) {
    const double edge = std::sqrt(2.0) * radius;
    Columns lattice({2 * edge, 20 * radius, 2 * edge}, {radius, radius});
    lattice.packing.positions.col(1) = lattice.packing.positions.col(0) + Eigen::Vector3d(edge, 0, edge);
    for (const double x : {-edge, edge}) {
        lattice.join(0, 1, {x, 0, edge});
        lattice.join(0, 1, {x, 0, -edge});
    }
    ContactModel model;
    model.young_modulus = 1e9;
    model.poisson_ratio = 0.3;
    const double modulus = 1e9 / (2 * (1 - 0.09));
    for (const double strain : {1e-6, 1e-5, 1e-4}) {
        const auto ramp =
            shear_to(lattice.packing, lattice.bonds, model, {.strain = strain, .steps = 2, .solver = {.orientation = zx}});
        const double force = 4.0 / 3 * modulus * std::sqrt(0.5 * radius) * std::pow(strain * edge / std::sqrt(2.0), 1.5);
        const double expected = 4 * edge * force / std::sqrt(2.0) / lattice.packing.cell.volume();
        EXPECT_NEAR(stress_zx(ramp.points.back()) / expected, 1, 3 * strain + 1e-5);
    }
}

/// JKR at controlled distance: the force passes the pull-off 3/2 pi W R, the bond breaks where the contact radius is
/// (pi W R^2 / 8 E)^(1/3), at 5/6 pi W R (Johnson, Contact Mechanics, 1985, sec. 5.5).
TEST(Quasistatic, AdhesiveBondPullsOffWhereJohnsonKendallAndRobertsSay) {
    const double length = 2 * radius;
    Columns chain({20 * radius, 20 * radius, length}, {radius});
    chain.join(0, {0, 0, length});
    ContactModel model;
    model.young_modulus = 1e9;
    model.poisson_ratio = 0.3;
    model.work_of_adhesion = 0.05;
    const double modulus = 1e9 / (2 * (1 - 0.09));
    const double effective = 0.5 * radius;
    const auto overlap = [&](double a) { return a * a / effective - std::sqrt(2 * pi * 0.05 * a / modulus); };
    const double rest = std::cbrt(4.5 * pi * 0.05 * effective * effective / modulus);
    const double end = std::cbrt(pi * 0.05 * effective * effective / (8 * modulus));
    const double longest = 1 + (overlap(rest) - overlap(end)) / length;
    const double breaks_at = std::sqrt(longest * longest - 1);
    const auto ramp = shear_to(chain.packing, chain.bonds, model, {.strain = 0.15, .steps = 100, .solver = {.orientation = zx}});
    ASSERT_EQ(ramp.broken.size(), 1U);
    EXPECT_EQ(ramp.broken[0].cause, BreakageCause::pull_off);
    EXPECT_NEAR(ramp.broken[0].strain, breaks_at, 1e-7);
    double strongest = 0;
    double last = 0;
    for (const StrainPoint& point : ramp.points) {
        const double stretch = std::sqrt(1 + point.strain * point.strain);
        const double pull =
            point.strain > 0 ? stress_zx(point) * chain.packing.cell.volume() * stretch / (length * point.strain) : 0;
        strongest = std::max(strongest, pull);
        last = point.bonds == 1 ? pull : last;
    }
    EXPECT_NEAR(strongest / (1.5 * pi * 0.05 * effective), 1, 1e-3);
    EXPECT_NEAR(last / (5.0 / 6 * pi * 0.05 * effective), 1, 1e-3);
}

/// Simple cubic lattice of Hertz-Mindlin contacts under a prestress F: every particle turns by half the strain, so that
/// G = k_s / 2 L - F / L^2 with k_s = 8 G* sqrt(R U), U the overlap under F.
TEST(Quasistatic, PrestressedMindlinLatticeInClosedForm) {
    const double length = 2 * radius;
    Columns lattice({length, length, length}, {radius});
    lattice.join(0, {length, 0, 0});
    lattice.join(0, {0, length, 0});
    lattice.join(0, {0, 0, length});
    ContactModel model;
    model.young_modulus = 1e9;
    model.poisson_ratio = 0.3;
    model.prestress = 1e-8;
    const double modulus = 1e9 / (2 * (1 - 0.09));
    const double effective = 0.5 * radius;
    const double depth = std::pow(1e-8 / (4.0 / 3 * modulus * std::sqrt(effective)), 2.0 / 3);
    const double shear = 8 * 1e9 / (4 * 1.3 * 1.7) * std::sqrt(effective * depth);
    const double expected = shear / (2 * length) - 1e-8 / (length * length);
    for (const double found : small_strain_moduli(lattice.packing, lattice.bonds, model, 1e-6)) {
        EXPECT_NEAR(found / expected, 1, 1e-5);
    }
}

/// Ramp through many breakages.
RampResponse broken_gel(const generators::VoidExpansion& sample, Index steps) {
    ContactModel model = stiff_joints();
    model.normal_strength = 1.2e-8;
    model.friction = 0.3;
    return shear_to(sample.packing, sample.contacts, model, {.strain = 4e-3, .steps = steps});
}

TEST(Quasistatic, FailureDoesNotDependOnTheStep) {
    const auto sample = gel(200);
    const RampResponse coarse = broken_gel(sample, 8);
    const RampResponse fine = broken_gel(sample, 40);
    ASSERT_GT(coarse.broken.size(), 3U);
    ASSERT_EQ(coarse.broken.size(), fine.broken.size());
    for (std::size_t k = 0; k < coarse.broken.size(); ++k) {
        EXPECT_EQ(coarse.broken[k].bond, fine.broken[k].bond);
        EXPECT_NEAR(coarse.broken[k].strain / fine.broken[k].strain, 1, 1e-4);
    }
    EXPECT_NEAR(stress_zx(coarse.points.back()) / stress_zx(fine.points.back()), 1, 1e-4);
    EXPECT_GT(fine.points.back().breakage, 0);
}

TEST(Quasistatic, EnergyBalanceOfACycleWithBreakageAndFriction) {
    const auto sample = gel(200);
    ContactModel model = stiff_joints();
    model.normal_strength = 1.2e-8;
    model.friction = 0.3;
    const auto sweep = sweep_amplitudes(sample.packing, sample.contacts, model, {.amplitudes = {1e-3, 3e-3, 1e-3}});
    EXPECT_GT(sweep.broken.size(), 0U);
    for (const AmplitudeResponse& response : sweep.amplitudes) {
        EXPECT_LT(response.balance_error, 1e-6) << response.amplitude;
        EXPECT_NEAR(response.loss_modulus * pi * response.amplitude * response.amplitude, response.loop_area,
                    1e-9 * response.storage_modulus * response.amplitude * response.amplitude);
        EXPECT_GE(response.loss_modulus, -1e-6 * response.storage_modulus);
    }
    EXPECT_LT(sweep.amplitudes[2].storage_modulus, sweep.amplitudes[0].storage_modulus) << "broken bonds soften";
}

TEST(Quasistatic, NetworkThatCarriesNothingHasModulusZero) {
    Packing island = random_spheres(8, 3.0, 1.0e-6, 5);
    island.cell = Cell::periodic(Eigen::Vector3d::Constant(50e-6));
    const ContactNetwork bonds = find_contacts(island, 0.2);
    ASSERT_GT(bonds.size(), 0);
    const auto ramp = shear_to(island, bonds, springs(), {.strain = 1e-4, .steps = 2});
    EXPECT_LT(std::abs(ramp.secant_modulus(ramp.points.size() - 1, zx)), 1e-6);
    const auto sweep = sweep_amplitudes(random_spheres(3, 60.0, 1.0e-6, 2), {.particles = 3, .ends = {}, .branch = {}}, springs(),
                                        {.amplitudes = {1e-3}});
    EXPECT_EQ(sweep.amplitudes[0].storage_modulus, 0);
    EXPECT_EQ(sweep.amplitudes[0].third_harmonic, 0);
    EXPECT_EQ(sweep.amplitudes[0].balance_error, 0);
}

TEST(Quasistatic, SameBitsForAnyNumberOfThreads) {
    const auto sample = gel(200);
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    const RampResponse one = broken_gel(sample, 4);
    omp_set_num_threads(2);
    const RampResponse two = broken_gel(sample, 4);
    omp_set_num_threads(threads);
    ASSERT_EQ(one.points.size(), two.points.size());
    for (std::size_t k = 0; k < one.points.size(); ++k) {
        EXPECT_EQ(one.points[k].strain, two.points[k].strain);
        EXPECT_EQ(one.points[k].stress, two.points[k].stress);
        EXPECT_EQ(one.points[k].stored, two.points[k].stored);
    }
}

TEST(Quasistatic, CanBeCancelled) {
    const auto sample = gel(200);
    int calls = 0;
    const Progress stop([&](std::string_view, double, std::string_view) { return ++calls < 5; });
    EXPECT_THROW(shear_to(sample.packing, sample.contacts, stiff_joints(), {.strain = 1e-3}, stop), Cancelled);
}

TEST(Quasistatic, SaysWhereNoEquilibriumIsFound) {
    Columns chain({20 * radius, 20 * radius, 2 * radius}, {radius});
    chain.join(0, {0, 0, 2 * radius});
    try {
        shear_to(chain.packing, chain.bonds, springs(),
                 {.strain = 1e300, .steps = 1, .solver = {.orientation = zx, .smallest_step = 1}});
        FAIL() << "a strain of 1e300 has no equilibrium in floating-point numbers";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no equilibrium was found"), std::string::npos) << error.what();
    }
}

TEST(Quasistatic, RefusesRatesAndImpossibleOptions) {
    Columns chain({20 * radius, 20 * radius, 2 * radius}, {radius});
    chain.join(0, {0, 0, 2 * radius});
    const auto refused = [&](double ContactModel::*parameter, double value) {
        ContactModel model = springs();
        model.*parameter = value;
        if (parameter == &ContactModel::normal_maxwell_stiffness) {
            model.normal_maxwell_time = 1;
        }
        EXPECT_THROW(shear_to(chain.packing, chain.bonds, model, {.strain = 1e-3}), std::invalid_argument);
    };
    refused(&ContactModel::normal_viscosity, 1e-6);
    refused(&ContactModel::normal_maxwell_stiffness, 1);
    refused(&ContactModel::solvent_viscosity, 1e-3);
    EXPECT_THROW(shear_to(chain.packing, chain.bonds, springs(), {}), std::invalid_argument);
    EXPECT_THROW(shear_to(chain.packing, chain.bonds, springs(), {.strain = 1e-3, .steps = 0}), std::invalid_argument);
    EXPECT_THROW(sweep_amplitudes(chain.packing, chain.bonds, springs(), {}), std::invalid_argument);
    EXPECT_THROW(sweep_amplitudes(chain.packing, chain.bonds, springs(), {.amplitudes = {1e-3}, .steps_per_cycle = 6}),
                 std::invalid_argument);
    ContactModel ageing = springs();
    ageing.ageing_rate = 0.1;
    ageing.ageing_time = 1;
    EXPECT_THROW(sweep_amplitudes(chain.packing, chain.bonds, ageing, {.amplitudes = {1e-3}}), std::invalid_argument);
}

TEST(Quasistatic, AgeingStiffensFromAmplitudeToAmplitude) {
    const auto sample = gel(200);
    ContactModel model = stiff_joints();
    model.ageing_rate = 0.1;
    model.ageing_time = 2;
    const auto sweep = sweep_amplitudes(sample.packing, sample.contacts, model, {.amplitudes = {1e-6, 1e-6}, .frequency = 0.25});
    EXPECT_NEAR(sweep.amplitudes[1].storage_modulus / sweep.amplitudes[0].storage_modulus, 1 + 0.1 * std::log(3.0), 1e-5);
}

TEST(YieldStrain, InterpolatesAndSaysWhenThereIsNone) {
    EXPECT_NEAR(yield_strain({1, 2, 3}, {10, 9.5, 8.5}, 0.9), 2.5, 1e-12);
    EXPECT_TRUE(std::isnan(yield_strain({1, 2}, {10, 9.5}, 0.9)));
}

}  // namespace
}  // namespace coagula::mechanics
