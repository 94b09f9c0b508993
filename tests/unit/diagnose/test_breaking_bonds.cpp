// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps over bonds that break: what is lost belongs to the energy between two strains, not to a strain, and is lost once.
#include "chain/forward.hpp"
#include "hidden_effects.hpp"
#include "responses/amplitude_response.hpp"

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

constexpr double critical = 1.5e-4;

Settings weak() {
    Settings settings;
    settings.critical_strain = critical;
    return settings;
}

/// G* / G of the first oscillation at a load after another.
Complex response(double from, double to) {
    return amplitude_response(simulator(), weak(), from * critical, to * critical)[0];
}

TEST(BreakingBonds, LoseTheSameEnergyInStepsOfAnySize) {
    const auto lost = [](double from, double to) { return to * to * response(from, to).imag(); };
    EXPECT_NEAR(lost(0, 7.3), lost(0, 2.6) + lost(2.6, 5.1) + lost(5.1, 7.3), 1e-12);
    EXPECT_GT(lost(0, 7.3), 0);
}

TEST(BreakingBonds, LoseNothingUpToTheLargestStrainSoFar) {
    const Complex settled = response(6, 6);
    EXPECT_EQ(settled.imag(), 0);
    EXPECT_EQ(response(6, 2), settled);
    EXPECT_LT(settled.real(), response(5.99, 6).real() + 1e-12) << "bonds carry load until they break";
}

/// What is lost over what the springs of the network had stored that is gone: a bond that breaks at a load takes stiffness with it
/// and half of the square of the load times that in energy, G'' being the energy over pi. Bonds on both sides of an oscillation and
/// the recoil make it somewhat more than that. @param loads of a sweep, and what it shows at them.
double lost_over_stored(const std::vector<double>& loads, const std::vector<Yielded>& shown) {
    double lost = 0;
    double stored = 0;
    double load = 0;
    double storage = 1;
    for (std::size_t k = 0; k < loads.size(); ++k) {
        const double mean_square = (loads[k] * loads[k] + loads[k] * load + load * load) / 3;
        lost += loads[k] * loads[k] * shown[k].first.imag();
        stored += mean_square * (storage - shown[k].settled) / (2 * std::numbers::pi);
        load = loads[k];
        storage = shown[k].settled;
    }
    return lost / stored;
}

/// In the curve and in runs at the strains of a sweep, in fine and in coarse steps. (Were the loss of a step not
/// in proportion to its size, it would be less than half; two structures of 200 particles scatter by a third.)
TEST(BreakingBonds, LoseWhatTheNetworkHadStored) {
    for (const double step : {0.4, 1.6}) {
        std::vector<double> loads;
        std::vector<double> amplitudes;
        std::vector<Yielded> curve;
        for (double load = step; load < 6.5; load += step) {
            curve.push_back({response(load - step, load), response(load, load).real()});
            loads.push_back(load);
            amplitudes.push_back(load * critical);
        }
        const std::vector<Yielded> runs = exact_amplitude_response(simulator(), weak(), amplitudes);
        for (const std::vector<Yielded>& shown : {curve, runs}) {
            EXPECT_GT(lost_over_stored(loads, shown), 0.7) << step;
            EXPECT_LT(lost_over_stored(loads, shown), 1.8) << step;
            EXPECT_LT(shown.back().settled, 0.6) << step;
        }
        for (std::size_t k = 0; k < loads.size(); ++k) {
            EXPECT_NEAR(runs[k].first.real(), curve[k].first.real(), 0.1) << loads[k];  // it is by chance which bond goes first
        }
    }
}

/// A run at two amplitudes far from each other has the nodes of the strength curve between them.
TEST(BreakingBonds, RunsBetweenAmplitudesToo) {
    Settings settings;
    settings.critical_strain = 1e-4;
    const YieldCurves run = exact_yield_curve(simulator(), settings, {1e-4, 16e-4});
    const auto settled = [&](double load) { return run.response(load, load)[0].real(); };
    const std::vector<double> loads{1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16};
    std::vector<double> amplitudes;
    for (const double load : loads) {
        amplitudes.push_back(1e-4 * load);
    }
    const std::vector<Yielded> nodes = exact_amplitude_response(simulator(), settings, amplitudes);
    for (std::size_t k = 1; k < loads.size(); ++k) {
        EXPECT_NEAR(settled(loads[k]), nodes[k].settled, 1e-12) << loads[k];
        EXPECT_NEAR(run.response(loads[k - 1], loads[k])[0].imag(), nodes[k].first.imag(), 1e-12) << loads[k];
    }
    const double between_two = settled(1) + 4.2 / 15 * (settled(16) - settled(1));
    EXPECT_GT(std::abs(settled(5.2) - between_two), 0.05) << "or two amplitudes would do";
}

/// A table of which every row was measured in the second oscillation at its strain.
TEST(BreakingBonds, AreGoneInTheSecondOscillation) {
    Measurement table{
        .kind = MeasurementKind::amplitude_sweep, .label = "sweep", .sample = "sample", .columns = {}, .left_out = {}};
    const std::vector<double> strains{2 * critical, 4 * critical, 6 * critical};
    table.columns = {{"strain", "1", strains}, {"storage_modulus", "Pa", {1, 1, 1}}, {"loss_modulus", "Pa", {1, 1, 1}}};
    const auto predicted = [&](int oscillations, bool exact) {
        table.oscillations = oscillations;
        Experiment experiment;
        experiment.measurements = {table};
        const auto rows = observations_of(experiment);
        return Forward(experiment, rows, simulator()).predict(weak(), exact);
    };
    for (const bool exact : {false, true}) {
        const Eigen::VectorXd first = predicted(1, exact);
        const Eigen::VectorXd second = predicted(2, exact);
        EXPECT_TRUE(second.tail(3).isZero()) << second.transpose();
        EXPECT_GT(first.tail(2).minCoeff(), 0);
        EXPECT_TRUE((second.segment(1, 2).array() < first.segment(1, 2).array()).all());
        EXPECT_EQ(predicted(5, exact), second);
    }
}

}  // namespace
}  // namespace coagula::diagnose
