// Sweeps over bonds that break: what is lost belongs to the energy between two strains, not to a strain, and is lost once.
#include "forward.hpp"
#include "hidden_effects.hpp"

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
    return simulator().amplitude_response(weak(), from * critical, to * critical)[0];
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

/// Runs at four amplitudes against the curve, which comes from fifteen: with the loss of a step of the curve in place of the energy
/// between the amplitudes, G'' would be less than half of it. (Where most is broken it is by chance which bond goes first.)
TEST(BreakingBonds, AreMetByRunsInCoarseSteps) {
    const std::vector<double> loads{1.6, 3.2, 4.8, 6.4};
    std::vector<double> amplitudes;
    for (const double load : loads) {
        amplitudes.push_back(load * critical);
    }
    const std::vector<Yielded> runs = simulator().exact_amplitude_response(weak(), amplitudes);
    double lost = 0;
    double expected = 0;
    for (std::size_t k = 0; k < loads.size(); ++k) {
        const Complex curve = response(k > 0 ? loads[k - 1] : 0, loads[k]);
        EXPECT_NEAR(runs[k].first.real(), curve.real(), 0.05) << loads[k];
        EXPECT_NEAR(runs[k].settled, response(loads[k], loads[k]).real(), 0.05) << loads[k];
        lost += loads[k] * loads[k] * runs[k].first.imag();
        expected += loads[k] * loads[k] * curve.imag();
    }
    EXPECT_NEAR(lost / expected, 1, 0.25);
    EXPECT_LT(runs.back().settled, 0.6);
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
