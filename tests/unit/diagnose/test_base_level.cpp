// SPDX-License-Identifier: GPL-3.0-or-later
// Where a model lies whose stiffness nobody has told.
#include "hidden_effects.hpp"
#include "infer/hypothesis.hpp"
#include "noise/data_set.hpp"

#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

constexpr double softening_strain = 0.003;
constexpr double exponent = 0.8;
constexpr double loss_at_half = 0.15;

/// Two samples under a growing strain, with both moduli by the law of Kraus: errors of 2 % and 0.5 % of |G*| in size and across.
Experiment softened_under_strain() {
    const std::vector<double> strains = logarithmic_steps(3e-5, 0.01, 14);
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    for (std::uint64_t sample = 1; sample < 3; ++sample) {
        const std::string name = sample == 1 ? "A" : "B";
        Measurement table{.kind = MeasurementKind::amplitude_sweep, .label = name, .sample = name, .columns = {}, .left_out = {}};
        table.columns = {{"strain", "1", strains},
                         {"storage_modulus", "Pa", {}},
                         {"loss_modulus", "Pa", {}},
                         {"angular_frequency", "rad/s", std::vector<double>(strains.size(), 10.0)}};
        for (std::size_t row = 0; row < strains.size(); ++row) {
            const double opened = std::pow(strains[row] / softening_strain, exponent);
            const std::complex<double> error(1 + 0.02 * drawn_normal(sample, 2 * row), 0.005 * drawn_normal(sample, 2 * row + 1));
            const std::complex<double> modulus =
                1e5 * std::complex<double>(1, 2 * loss_at_half * opened) / (1 + opened * opened) * error;
            table.columns[1].values.push_back(modulus.real());
            table.columns[2].values.push_back(modulus.imag());
        }
        experiment.measurements.push_back(std::move(table));
    }
    return experiment;
}

/// Fits without a known stiffness.
class FreeLevel : public ::testing::Test {
protected:
    Fit fit(const Hypothesis& hypothesis) const { return inference_.fit(hypothesis); }

    double predicted_over_measured(const Fit& fit) const {
        const Eigen::VectorXd predicted = inference_.prediction(fit.model).without_errors();
        std::vector<double> ratios;
        for (Index row = 0; row < data_.size(); ++row) {
            if (predicted[row] > 0) {
                ratios.push_back(predicted[row] / data_.values[row]);
            }
        }
        std::sort(ratios.begin(), ratios.end());
        return ratios[ratios.size() / 2];
    }

private:
    Experiment experiment_ = softened_under_strain();
    StatedNoise stated_{.sample = 0.1};
    DataSet data_ =
        data_set_of(experiment_, estimated_errors(experiment_, noise_of_tables(experiment_.measurements, stated_), stated_));
    Forward forward_{experiment_, data_.observations, simulator()};
    ErrorModel errors_{data_};
    Inference inference_{forward_, errors_};
};

/// The base model has no loss. Its phase is nowhere wrong where it predicts nothing at all.
TEST_F(FreeLevel, TheBaseModelLiesAmongTheData) {
    const double ratio = predicted_over_measured(fit({}));
    EXPECT_GT(ratio, 0.25);
    EXPECT_LT(ratio, 4);
}

TEST_F(FreeLevel, TheLawThatMadeTheDataIsFoundFromAfar) {
    const Fit softening = fit({find_mechanism("reversible-softening")});
    EXPECT_NEAR(softening.values()[0], softening_strain, 0.05 * softening_strain);
    EXPECT_NEAR(softening.values()[1], exponent, 0.03);
    EXPECT_NEAR(softening.values()[2], loss_at_half, 0.01);
    EXPECT_NEAR(predicted_over_measured(softening), 1, 0.1);
}

}  // namespace
}  // namespace coagula::diagnose
