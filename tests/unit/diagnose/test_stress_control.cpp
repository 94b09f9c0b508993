// SPDX-License-Identifier: GPL-3.0-or-later
// Runs under a set stress, in which the strain is no axis.
#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/stress_control.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include "hidden_effects.hpp"
#include "observables/observations.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {
namespace {

constexpr double set_stress = 5;            // Pa
constexpr double hidden_inertia = 26.2e-6;  // kg.m2
constexpr double highest = 63;              // rad/s, where G' is about -150 Pa

/// A soft solid under a plate whose inertia nobody took off, the stress of every row the same.
Measurement sweep_under_stress() {
    const double per_torque = 2 * 1e-3 / (std::numbers::pi * std::pow(0.02, 4));
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "sweep";
    table.sample = "A";
    table.columns = {{"angular_frequency", "rad/s", logarithmic_steps(0.3, highest, 16)},
                     {"strain", "1", {}},
                     {"stress", "Pa", std::vector<double>(16, set_stress)},
                     {"storage_modulus", "Pa", {}},
                     {"loss_modulus", "Pa", {}}};
    for (std::size_t row = 0; row < 16; ++row) {
        const double frequency = table.columns[0].values[row];
        const std::complex<double> product(0, frequency);
        const std::complex<double> sample = 150.0 * std::pow(0.3 * product, 0.15) + 0.3 * product;
        const std::complex<double> seen = sample - hidden_inertia * per_torque * frequency * frequency;
        const double error = 0.01 * std::abs(seen);
        table.columns[3].values.push_back(seen.real() + error * drawn_normal(7, 2 * row));
        table.columns[4].values.push_back(seen.imag() + error * drawn_normal(7, 2 * row + 1));
        for (std::size_t column : {3U, 4U}) {
            table.columns[column].standard_errors.push_back(error);
        }
        table.columns[1].values.push_back(set_stress / std::hypot(table.columns[3].values[row], table.columns[4].values[row]));
    }
    return table;
}

TEST(StressControl, IsToldByAStressThatStays) {
    Measurement table = sweep_under_stress();
    EXPECT_TRUE(is_stress_controlled(table));
    for (const double strain : set_strains(table)) {
        EXPECT_DOUBLE_EQ(strain, set_strains(table).front());
    }
    // Without a column of the stress by strain times |G*|.
    Measurement without = table;
    without.columns.erase(without.columns.begin() + 2);
    EXPECT_TRUE(is_stress_controlled(without));
    // In steps, and by word.
    Measurement stepped = table;
    for (std::size_t row = 8; row < 16; ++row) {
        stepped.columns[1].values[row] *= 4;
        stepped.columns[2].values[row] *= 4;
    }
    EXPECT_TRUE(is_stress_controlled(stepped));
    EXPECT_NEAR(set_strains(stepped).back() / set_strains(stepped).front(), 4, 1e-9);
    table.stress_controlled = false;
    EXPECT_FALSE(is_stress_controlled(table));
    EXPECT_EQ(set_strains(table), table.columns[1].values);
}

TEST(StressControl, IsNotToldOfSetStrains) {
    Measurement table = sweep_under_stress();
    table.columns[1].values.assign(16, 0.01);
    for (std::size_t row = 0; row < 16; ++row) {
        table.columns[2].values[row] = 0.01 * std::hypot(table.columns[3].values[row], table.columns[4].values[row]);
    }
    EXPECT_FALSE(is_stress_controlled(table));
    table.columns[1].values = logarithmic_steps(0.001, 1, 16);  // neither stays
    EXPECT_FALSE(is_stress_controlled(table));
    table.columns.erase(table.columns.begin() + 1);
    EXPECT_FALSE(is_stress_controlled(table));
}

/// The strain runs with the frequency: a material that may vary along it would take the inertia over.
TEST(StressControl, ASmoothMaterialDoesNotVaryAlongTheStrainThatFollows) {
    Experiment experiment;
    experiment.material.kind = MaterialKind::smooth;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.02, .gap = 1e-3};
    experiment.measurements = {sweep_under_stress()};
    DiagnosisOptions options;
    options.bootstrap = 199;
    options.errors.sample = 0.02;
    const auto inertia_in = [&] {
        const Diagnosis found = diagnose(experiment, simulator(), options);
        const auto cause =
            std::find_if(found.causes.begin(), found.causes.end(), [](const Cause& one) { return one.name() == "tool-inertia"; });
        return cause == found.causes.end() ? EstimatedParameter{} : cause->parameters.back();
    };
    const EstimatedParameter with_strain = inertia_in();
    std::erase_if(experiment.measurements[0].columns,
                  [](const Column& column) { return column.name == "strain" || column.name == "stress"; });
    const EstimatedParameter without_strain = inertia_in();
    EXPECT_NEAR(with_strain.value, without_strain.value, 1e-3 * hidden_inertia);
    EXPECT_NEAR(with_strain.value, hidden_inertia, 0.05 * hidden_inertia);
}

}  // namespace
}  // namespace coagula::diagnose
