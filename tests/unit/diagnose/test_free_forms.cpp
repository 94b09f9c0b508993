// SPDX-License-Identifier: GPL-3.0-or-later
// Which link a departure acts like, where no cause is asked.
#include "hidden_effects.hpp"
#include "infer/free_forms.hpp"
#include "noise/data_set.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// A time sweep of a sample, or of an oil of 5 Pa.s, which shows this factor on both moduli.
Measurement run_between_plates(const std::string& sample, double gap, double factor, bool oil) {
    constexpr std::size_t rows = 6;
    const std::uint64_t seed = static_cast<std::uint64_t>(sample.front()) + static_cast<std::uint64_t>(1e6 * gap);
    const auto all = [](double value) { return std::vector<double>(rows, value); };
    Measurement table{
        .kind = MeasurementKind::time_sweep, .label = sample, .sample = oil ? "oil" : sample, .columns = {}, .left_out = {}};
    table.columns = {{"time", "s", {10, 30, 100, 300, 1000, 3000}},
                     {"loss_modulus", "Pa", {}},
                     {"angular_frequency", "rad/s", all(6)},
                     {"gap", "m", all(gap)},
                     {"plate_radius", "m", all(0.0125)}};
    for (std::size_t row = 0; row < rows; ++row) {
        table.columns[1].values.push_back(factor * (oil ? 30 : 100) * (1 + 0.01 * drawn_normal(seed, row)));
        table.columns[1].standard_errors.push_back(0.01 * (oil ? 30 : 100));
    }
    if (oil) {
        table.fluid_viscosity = 5;
    } else {
        table.columns.push_back({"storage_modulus", "Pa", {}});
        for (std::size_t row = 0; row < rows; ++row) {
            table.columns.back().values.push_back(factor * 1000 * (1 + 0.01 * drawn_normal(seed, row + rows)));
            table.columns.back().standard_errors.push_back(10);
        }
    }
    return table;
}

Kind best_form_of(const Experiment& experiment) {
    const DataSet data = data_set_of(experiment, {.sample = 0.01});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    return free_forms(inference, inference.fit({})).front().kind;
}

/// The form with the largest evidence, for two gaps and a factor of 1.15 at the smaller one; as the oil shows it.
Kind best_form(std::optional<double> factor_of_oil) {
    Experiment experiment;
    experiment.material.kind = MaterialKind::smooth;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    for (const char* sample : {"A", "B", "C", "D"}) {
        const bool near = sample[0] > 'B';
        experiment.measurements.push_back(run_between_plates(sample, near ? 5e-4 : 1e-3, near ? 1.15 : 1, false));
    }
    if (factor_of_oil) {
        experiment.measurements.push_back(run_between_plates("o", 1e-3, 1, true));
        experiment.measurements.push_back(run_between_plates("p", 5e-4, *factor_of_oil, true));
    }
    return best_form_of(experiment);
}

/// An oil shows what the plates do. The rest is in the samples, or in how they were filled.
TEST(FreeForms, AnOilTellsPlatesFromFillings) {
    EXPECT_EQ(best_form(1.15), (Kind{Link::geometry, Axis::gap}));
    EXPECT_EQ(best_form(1.0), (Kind{Link::history, Axis::gap}));
    EXPECT_EQ(best_form(std::nullopt).axis, Axis::gap);
    EXPECT_NE(best_form(std::nullopt).link, Link::history) << "without an oil it may be the plates";
}

/// An amplitude sweep of a network under a plate. `factor` is on both moduli, of the strain and of the torque over that at a strain
/// of 1e-3 under a plate of 12.5 mm.
template <class Factor>
Measurement swept_under(double plate_radius, const Factor& factor) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-2, 16);
    const auto all = [&](double value) { return std::vector<double>(strains.size(), value); };
    std::vector<std::complex<double>> moduli;
    for (const double strain : strains) {
        moduli.emplace_back(1e5 * factor(strain, strain / 1e-3 * std::pow(plate_radius / 0.0125, 3)));
    }
    Measurement table{.kind = MeasurementKind::amplitude_sweep,
                      .label = "sweep",
                      .sample = std::to_string(plate_radius),
                      .columns = {},
                      .left_out = {}};
    table.columns = {{"strain", "1", strains},
                     {"angular_frequency", "rad/s", all(6)},
                     {"gap", "m", all(1e-3)},
                     {"plate_radius", "m", all(plate_radius)}};
    add_moduli(table, moduli, 0.005, static_cast<std::uint64_t>(1e6 * plate_radius));
    return table;
}

template <class Factor>
Kind best_form_under_two_plates(const Factor& factor) {
    Experiment experiment;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    experiment.measurements = {swept_under(0.0125, factor), swept_under(0.025, factor)};
    return best_form_of(experiment);
}

/// Under plates of two radii the same strain comes with torques eight times apart.
TEST(FreeForms, TwoPlatesTellAReadingOfTheTorqueFromTheMaterial) {
    EXPECT_EQ(best_form_under_two_plates([](double /*strain*/, double torque) { return 1 + 0.06 * torque / (10 + torque); }),
              (Kind{Link::tool, Axis::strain}));
    EXPECT_EQ(best_form_under_two_plates([](double strain, double /*torque*/) { return 1 + 0.06 * strain / (1e-3 + strain); }),
              (Kind{Link::material, Axis::strain}));
}

/// Tables at one strain each: samples under the wider plate are a tenth stiffer, an oil is not. They come with other torques, but
/// also from another batch.
TEST(FreeForms, TablesOfOneStrainEachAreNoReadingOfTheTorque) {
    Experiment experiment;
    experiment.material.kind = MaterialKind::smooth;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    for (const char* sample : {"A", "B", "C", "D", "o", "p"}) {
        const bool oil = sample[0] >= 'o';
        const bool wide = sample[0] == 'C' || sample[0] == 'D' || sample[0] == 'p';
        Measurement table = run_between_plates(sample, 1e-3, wide && !oil ? 1.1 : 1, oil);
        table.columns[4].values.assign(6, wide ? 0.025 : 0.0125);
        table.columns.push_back({"strain", "1", std::vector<double>(6, oil ? 0.02 : 1e-3)});
        experiment.measurements.push_back(table);
    }
    EXPECT_EQ(best_form_of(experiment).axis, Axis::radius);
}

}  // namespace
}  // namespace coagula::diagnose
