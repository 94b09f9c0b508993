// SPDX-License-Identifier: GPL-3.0-or-later
// Third harmonics of the stress: what the terms of the simulation make of them, against closed form and explicit steps, and what
// waveforms tell that moduli do not.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/diagnose/waveform.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double frequency = 2 * pi;  // rad/s

Measurement table_of(MeasurementKind kind, std::vector<Column> columns) {
    return {.kind = kind, .label = "hidden", .sample = "sample", .columns = std::move(columns), .left_out = {}};
}

/// G3* / |G*| of the first oscillations at these strains, one after the other.
std::vector<Complex> predicted(const Model& model, const std::vector<double>& strains, Simulator& structures = simulator()) {
    const std::vector<double> zeros(strains.size(), 0.0);
    Experiment experiment;
    experiment.measurements = {
        table_of(MeasurementKind::harmonics,
                 {{"strain", "1", strains}, {"third_harmonic_storage", "1", zeros}, {"third_harmonic_loss", "1", zeros}})};
    const auto rows = observations_of(experiment);
    const Eigen::VectorXd values = Forward(experiment, rows, structures).predict(model);
    std::vector<Complex> all(strains.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double value = values[static_cast<Eigen::Index>(k)];
        all[rows[k].row] += is_loss(rows[k]) ? Complex(0, value) : Complex(value, 0);
    }
    return all;
}

/// One oscillation as a rheometer writes it down.
Measurement waveform(const std::vector<double>& strain, const std::vector<double>& stress) {
    std::vector<double> time;
    for (std::size_t k = 0; k < strain.size(); ++k) {
        time.push_back(2 * pi / frequency * static_cast<double>(k + 1) / static_cast<double>(strain.size()));
    }
    return table_of(MeasurementKind::waveform, {{"time", "s", time},
                                                {"strain", "1", strain},
                                                {"stress", "Pa", stress},
                                                {"angular_frequency", "rad/s", std::vector<double>(strain.size(), frequency)}});
}

/// The waveforms of the oscillations of an explicit run.
std::vector<Measurement> waveforms_of(const mechanics::RheometerRun& run) {
    std::vector<Measurement> all;
    const std::size_t samples = run.strain.size() / run.oscillations.size();
    for (std::size_t k = 0; k < run.oscillations.size(); ++k) {
        const auto part = [&](const std::vector<double>& values) {
            const auto from = values.begin() + static_cast<std::ptrdiff_t>(k * samples);
            return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(samples));
        };
        all.push_back(waveform(part(run.strain), part(run.stress)));
    }
    return all;
}

Complex third_harmonic(const Measurement& one) {
    const auto found = harmonics_of(one);
    return {found->third_harmonic_storage, found->third_harmonic_loss};
}

mechanics::RheometerOptions options_of(const ContactModel& model, const std::vector<double>& strains) {
    mechanics::RheometerOptions run;
    run.model = model;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.amplitude = strains.back();
    for (const double strain : strains) {
        run.course.push_back({strain / strains.back()});
    }
    run.oscillations = static_cast<int>(strains.size());
    run.steps_per_oscillation = 6000;
    run.damping = 0.7;
    run.compare_with_rest = false;
    return run;
}

/// Stress as the power 3/2 of the strain: sine coefficients of sin^n have the ratio (1 - n) / (n + 3).
TEST(ThirdHarmonic, OfHertzContactsWithoutLoadIsThatOfTheirPower) {
    Settings settings;
    settings.contact_preload = 1e-7;
    const Complex found = predicted(settings, {1e-2}).front();
    EXPECT_NEAR(found.real(), -1.0 / 9, 2e-3);
    EXPECT_NEAR(found.imag(), 0, 1e-9);
    settings.contact_preload = 1e-2;
    EXPECT_LT(std::abs(predicted(settings, {1e-5}).front()), 1e-3) << "small strains see springs";
    EXPECT_EQ(predicted({}, {1e-2}).front(), Complex(0));
}

TEST(ThirdHarmonic, OfHertzContactsIsThatOfExplicitSteps) {
    const Packing packing = structure(100, 3);
    Settings settings;
    settings.contact_preload = 1e-5;
    mechanics::RheometerOptions run = options_of(contact_model_of(settings, 0.25e-6), {1e-3, 1e-3});
    run.model.prestress = unset;
    run.steps_per_oscillation = 20000;
    const auto result = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, {{2, 1}});
    SimulationCache cache;
    Simulator alone({packing}, {"alone"}, cache);
    const Complex simulated = third_harmonic(waveforms_of(result.runs.front()).back());
    EXPECT_NEAR(simulated.real(), predicted(settings, {1e-3}, alone).front().real(), 0.03) << simulated;
}

/// Stress as strain + strain^3: sin^3 = (3 sin - sin 3) / 4.
TEST(ThirdHarmonic, OfALawOfTheStressIsThatOfItsPower) {
    Mechanism cubic{};
    cubic.effect = BendsStress{[](double strain, Values values) { return 1 + std::pow(strain / values[0], 2); }};
    Model model;
    model.acting = {{&cubic, {1e-2}}};
    const Complex found = predicted(model, {2e-2}).front();
    EXPECT_NEAR(found.real(), -0.25 * 4 / (1 + 0.75 * 4), 1e-12);
    EXPECT_NEAR(found.imag(), 0, 1e-12);
}

/// First oscillations in which bonds break, so slow that the rate of the run does not count; the mean over the two structures, and
/// over rows, because single bonds make steps.
TEST(ThirdHarmonic, OfBreakingBondsIsThatOfExplicitSteps) {
    Settings settings;
    settings.critical_strain = 1.5e-4;
    std::vector<double> strains{1e-6};
    for (const double load : {1.5, 3.0, 4.5, 6.0}) {
        strains.push_back(load * settings.critical_strain);
    }
    mechanics::RheometerOptions options = options_of(contact_model_of(settings, 0.25e-6), strains);
    options.steps_per_oscillation = 24000;
    Complex simulated = 0;
    for (const std::uint64_t seed : {1U, 2U}) {
        const Packing packing = structure(200, seed);
        const auto run = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), options, {{}});
        const std::vector<Measurement> rows = waveforms_of(run.runs.front());
        for (std::size_t k = 1; k < rows.size(); ++k) {
            simulated += third_harmonic(rows[k]) / 8.0;
        }
    }
    Complex expected = 0;
    const std::vector<Complex> rows = predicted(settings, strains);
    for (std::size_t k = 1; k < rows.size(); ++k) {
        expected += rows[k] / 4.0;
    }
    EXPECT_LT(std::abs(simulated - expected), 0.3 * std::abs(expected)) << simulated << expected;
    EXPECT_GT(std::abs(expected), 0.02);
}

/// Linear waveforms with errors of a part of the stress.
Measurement linear_waveform(double strain, double modulus, double error, std::uint64_t seed) {
    std::vector<double> strains;
    std::vector<double> stresses;
    for (int k = 0; k < 128; ++k) {
        strains.push_back(strain * std::sin(2 * pi * (k + 1) / 128));
        stresses.push_back(modulus * (strains.back() + error * strain * drawn_normal(seed, static_cast<std::uint64_t>(k))));
    }
    return waveform(strains, stresses);
}

TEST(ThirdHarmonic, AWaveformIsARowOfItsSweepAndCountsOnce) {
    Experiment experiment;
    experiment.measurements = {
        table_of(MeasurementKind::amplitude_sweep, {{"strain", "1", {1e-4, 2e-4, 4e-4}},
                                                    {"time", "s", {5, 15, 25}},
                                                    {"angular_frequency", "rad/s", {frequency, frequency, frequency}},
                                                    {"storage_modulus", "Pa", {100, 90, 50}}}),
        linear_waveform(2.01e-4, 90, 0, 1), linear_waveform(7e-4, 40, 0, 2)};
    ErrorSpec errors;
    reduce_waveforms(experiment, errors, 0.03, 0.01);
    ASSERT_EQ(experiment.measurements.size(), 2U);
    const Measurement& table = experiment.measurements[1];
    EXPECT_EQ(table.kind, MeasurementKind::harmonics);
    EXPECT_EQ(table.rows(), 2U);
    EXPECT_EQ(find_column(table, "time")->values[0], 15);
    EXPECT_TRUE(std::isnan(find_column(table, "time")->values[1]));
    EXPECT_TRUE(std::isnan(find_column(table, "storage_modulus")->values[0]));
    EXPECT_NEAR(find_column(table, "storage_modulus")->values[1], 40, 1e-6);
    EXPECT_NEAR(find_errors(errors, 1, "storage_modulus")->deviations[1], 40 * std::hypot(0.03, 0.002), 1e-6);
    const auto rows = observations_of(experiment);
    EXPECT_EQ(rows.size(), 3U + 4U + 2U);
    experiment.measurements.push_back(
        table_of(MeasurementKind::waveform, {{"time", "s", {0, 1}}, {"strain", "1", {0, 1}}, {"stress", "Pa", {0, 1}}}));
    EXPECT_THROW(reduce_waveforms(experiment, errors, 0.03, 0.01), InputError);
}

TEST(ThirdHarmonic, AFrequencyThatIsNotStatedIsThatOfTheWaveform) {
    const auto moduli_in_waveform = [](std::vector<Column> more) {
        Experiment experiment;
        experiment.measurements = {
            table_of(MeasurementKind::amplitude_sweep, {{"strain", "1", {1e-4, 2e-4}}, {"storage_modulus", "Pa", {100, 90}}}),
            linear_waveform(2e-4, 90, 0, 1)};
        auto& columns = experiment.measurements[0].columns;
        columns.insert(columns.end(), more.begin(), more.end());
        ErrorSpec errors;
        reduce_waveforms(experiment, errors, 0.03, 0.01);
        return find_column(experiment.measurements[1], "storage_modulus") != nullptr;
    };
    EXPECT_FALSE(moduli_in_waveform({}));
    EXPECT_FALSE(moduli_in_waveform({{"frequency", "Hz", {1, 1}}}));
    EXPECT_TRUE(moduli_in_waveform({{"frequency", "Hz", {2, 2}}}));
}

TEST(ThirdHarmonic, OfAnOilIsNotThatOfTheSample) {
    Experiment experiment;
    experiment.measurements = {table_of(MeasurementKind::amplitude_sweep, {{"strain", "1", {1e-3}},
                                                                           {"frequency", "Hz", {1}},
                                                                           {"loss_modulus", "Pa", {6.3}},
                                                                           {"third_harmonic_storage", "1", {0}},
                                                                           {"third_harmonic_loss", "1", {0}}})};
    EXPECT_EQ(observations_of(experiment).size(), 3U);
    experiment.measurements[0].fluid_viscosity = 1;
    const auto rows = observations_of(experiment);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(observable_of(rows[0]).key, "loss_modulus");
}

/// Bonds that broke at smaller strains of the sweep have no part in the waveform of a later row.
TEST(ThirdHarmonic, ComesAfterTheRowsBeforeItsOwn) {
    Settings settings;
    settings.critical_strain = 1.5e-4;
    const auto at_last = [&](const std::vector<double>& strains) {
        Experiment experiment;
        const std::vector<double> ones(strains.size(), 1.0);
        experiment.measurements = {table_of(MeasurementKind::amplitude_sweep,
                                            {{"strain", "1", strains},
                                             {"storage_modulus", "Pa", ones},
                                             {"angular_frequency", "rad/s", std::vector<double>(strains.size(), frequency)}}),
                                   linear_waveform(strains.back(), 1, 0, 1)};
        ErrorSpec errors;
        reduce_waveforms(experiment, errors, 0.03, 0.01);
        const auto rows = observations_of(experiment);
        const Eigen::VectorXd values = Forward(experiment, rows, simulator()).predict(settings);
        return std::hypot(values[values.size() - 1], values[values.size() - 2]);
    };
    EXPECT_LT(at_last({2e-4, 7e-4, 7.5e-4}), 0.5 * at_last({2e-4, 7.5e-4}));
    EXPECT_GT(at_last({2e-4, 7.5e-4}), 0.03);
}

struct Sweep {
    Experiment experiment;
    ErrorSpec errors = {};
};

/// One sweep upwards with its waveforms.
Sweep sweep(const std::vector<double>& strains, const std::vector<double>& moduli, const std::vector<Measurement>& waveforms,
            double error, std::uint64_t seed) {
    std::vector<double> values;
    std::vector<double> errors;
    for (std::size_t k = 0; k < strains.size(); ++k) {
        errors.push_back(error * moduli[k]);
        values.push_back(moduli[k] + errors.back() * drawn_normal(seed, 1000 + k));
    }
    Sweep made;
    auto& tables = made.experiment.measurements;
    tables = {
        table_of(MeasurementKind::amplitude_sweep, {{"strain", "1", strains},
                                                    {"time", "s", logarithmic_steps(10, 1000, static_cast<int>(strains.size()))},
                                                    {"angular_frequency", "rad/s", std::vector<double>(strains.size(), frequency)},
                                                    {"storage_modulus", "Pa", values, errors}})};
    tables.insert(tables.end(), waveforms.begin(), waveforms.end());
    reduce_waveforms(made.experiment, made.errors, 0.03, 0.01);
    return made;
}

Diagnosis diagnosed(const Sweep& measured, std::vector<std::string> causes = {}) {
    DiagnosisOptions options;
    options.errors = measured.errors;
    options.bootstrap = 399;
    options.causes = std::move(causes);
    return diagnose(measured.experiment, simulator(), options);
}

std::vector<Measurement> linear_waveforms(const std::vector<double>& strains, const std::vector<double>& moduli,
                                          std::uint64_t seed) {
    std::vector<Measurement> all;
    for (std::size_t k = 0; k < strains.size(); ++k) {
        all.push_back(linear_waveform(strains[k], moduli[k], 0.01, seed + k));
    }
    return all;
}

/// Strain in equal steps at times in equal ratios: what grows with the age and with the strain looks alike. The waveforms show that
/// no strain changes the stiffness.
TEST(ThirdHarmonic, NothingInTheWaveformsLeavesAge) {
    std::vector<double> strains;
    for (int k = 1; k <= 16; ++k) {
        strains.push_back(1e-4 * k);
    }
    std::vector<double> moduli;
    for (const double time : logarithmic_steps(10, 1000, 16)) {
        moduli.push_back(2e5 * (1 + 0.3 * std::log10(1 + time)));
    }
    const std::vector<std::string> alike{"ageing", "contact-nonlinearity"};  // other laws in time are apart by their course
    const Diagnosis without = diagnosed(sweep(strains, moduli, {}, 0.1, 10), alike);
    EXPECT_EQ(without.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(without, "contact-nonlinearity"));
    const auto proposed = std::find_if(without.proposals.begin(), without.proposals.end(),
                                       [](const Proposal& one) { return one.measurement == "amplitude-sweep-with-waveforms"; });
    ASSERT_NE(proposed, without.proposals.end());
    // All that is open between the two.
    double entropy = 0;
    double both = 0;
    for (const Cause& one : without.causes) {
        const bool tied = std::find(alike.begin(), alike.end(), one.name()) != alike.end();
        entropy -= tied ? one.posterior * std::log2(one.posterior) : 0;
        both += tied ? one.posterior : 0;
    }
    entropy = entropy / both + std::log2(both);
    EXPECT_GT(proposed->information, 0.9 * entropy);
    const Diagnosis with = diagnosed(sweep(strains, moduli, linear_waveforms(strains, moduli, 50), 0.1, 10), alike);
    EXPECT_EQ(names_of(with.credible_set), (std::vector<std::string>{"ageing", "none of the catalogue"}))
        << missing_to_a_name(with);
}

/// Hertz contacts in explicit steps of a structure that the diagnosis does not know.
TEST(ThirdHarmonic, HertzContactsAreNamedByTheirWaveforms) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-2, 6);
    const Packing packing = structure(120, 78);
    std::vector<double> moduli;
    std::vector<Measurement> waveforms;
    for (const double strain : strains) {
        mechanics::RheometerOptions run = options_of({.normal_stiffness = 40, .shear_stiffness = 4}, {strain, strain});
        run.model.young_modulus = 70e9;
        run.model.poisson_ratio = 0.2;
        run.steps_per_oscillation = 20000;
        const auto result = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, {{1, 0}});
        waveforms.push_back(waveforms_of(result.runs.front()).back());
        moduli.push_back(result.runs.front().oscillations.back().fundamental_storage);
    }
    const Diagnosis found = diagnosed(sweep(strains, moduli, waveforms, 0.08, 4));
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.causes.front().name(), "contact-nonlinearity");
    EXPECT_EQ(found.verdict, Verdict::named);
}

TEST(ThirdHarmonic, OfALinearSampleIsNotFound) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-2, 12);
    const std::vector<double> moduli(strains.size(), 3e5);
    int detected = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        DiagnosisOptions options;
        options.seed = seed + 1;
        options.bootstrap = 199;
        const Sweep measured = sweep(strains, moduli, linear_waveforms(strains, moduli, 100 * seed), 0.05, 1000 * seed);
        options.errors = measured.errors;
        detected += diagnose(measured.experiment, simulator(), options).detected ? 1 : 0;
    }
    EXPECT_LE(detected, 4);  // of 20 at 5 %: more by chance in 0.3 %
}

}  // namespace
}  // namespace coagula::diagnose
