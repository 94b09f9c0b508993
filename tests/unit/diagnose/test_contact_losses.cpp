// SPDX-License-Identifier: GPL-3.0-or-later
// Dashpots and Maxwell elements in the contacts: their law, and sweeps of another structure by the frequency solver.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/mechanics/frequency.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

Measurement sweep(const std::vector<double>& frequencies, const std::vector<Complex>& moduli, double error, std::uint64_t seed) {
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "hidden";
    table.sample = "sample " + std::to_string(seed);
    Column frequency{"angular_frequency", "rad/s", {}};
    for (const double each : frequencies) {
        frequency.values.push_back(2 * pi * each);
    }
    table.columns = {frequency};
    add_moduli(table, moduli, error, seed);
    return table;
}

std::vector<Complex> moduli_of(const Packing& packing, const ContactModel& model, const std::vector<double>& frequencies) {
    std::vector<Complex> moduli;
    for (const auto& point : mechanics::solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, frequencies).points) {
        moduli.push_back(point.mean_shear_modulus());
    }
    return moduli;
}

/// Springs of particles of 0.04 N/m, two in series, and beside them what takes time. A stiffer gel brakes more than bearings do.
ContactModel springs() {
    return {.normal_stiffness = 0.04, .shear_stiffness = 0.004};
}

ContactModel with_dashpots(double time) {
    ContactModel model = springs();
    model.normal_viscosity = 0.02 * time;
    model.shear_viscosity = 0.002 * time;
    return model;
}

ContactModel with_relaxation(double share, double time) {
    ContactModel model = springs();
    model.normal_maxwell_stiffness = 0.02 * share;
    model.shear_maxwell_stiffness = 0.002 * share;
    model.normal_maxwell_time = model.shear_maxwell_time = time;
    return model;
}

/// What the diagnosis predicts is what the solver gives for the contact model that it writes; with drag, too.
TEST(ContactLosses, ExtendedModelRunsToTheSamePrediction) {
    const std::vector<double> frequencies{0.3, 7, 200};
    for (const double viscosity : {0.0, 8.0}) {
        Settings settings;
        settings.normal_stiffness = 55;
        settings.stiffness_ratio = 0.3;
        settings.dashpot_time = 2e-3;
        settings.relaxing_ratio = 0.7;
        settings.relaxation_time = 0.05;
        settings.springpot_ratio = 0.2;
        settings.springpot_exponent = 0.1;
        settings.felt_viscosity = viscosity;
        Experiment experiment;
        experiment.measurements = {sweep(frequencies, std::vector<Complex>(3, 1.0), 0, 1)};
        const auto rows = observations_of(experiment);
        const Eigen::VectorXd predicted = Forward(experiment, rows, simulator()).predict(settings, true);
        const ContactModel model = contact_model_of(settings, 0.25e-6);
        const auto first = moduli_of(structure(200, 1), model, frequencies);
        const auto second = moduli_of(structure(200, 2), model, frequencies);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const Complex mean = 0.5 * (first[rows[k].row] + second[rows[k].row]);
            EXPECT_NEAR(predicted[static_cast<Eigen::Index>(k)], part_of(mean, rows[k]), 1e-8 * std::abs(mean));
        }
    }
}

/// G* = G (1 + i w t) and G (1 + m i w t / (1 + i w t)) of any structure.
TEST(ContactLosses, FollowTheirLaws) {
    const std::vector<double> frequencies{0.1, 1, 10};
    const Packing packing = structure(200, 5);
    const double elastic = moduli_of(packing, springs(), {1}).front().real();
    const auto dashpots = moduli_of(packing, with_dashpots(3e-3), frequencies);
    const auto relaxing = moduli_of(packing, with_relaxation(0.4, 0.02), frequencies);
    Experiment experiment;
    experiment.measurements = {sweep(frequencies, std::vector<Complex>(3, 1.0), 0, 1)};
    const auto rows = observations_of(experiment);
    const auto ratio = [&](const char* name, std::vector<double> values) {
        const Forward forward(experiment, rows, simulator());
        const Eigen::VectorXd found = forward.predict(Model({find_mechanism(name)}, values));
        return (found / forward.predict(Model{})[0]).eval();
    };
    const Eigen::VectorXd dashpot = ratio("contact-dashpot", {3e-3});
    const Eigen::VectorXd relaxation = ratio("contact-relaxation", {0.4, 0.02});
    for (Eigen::Index k = 0; k < 3; ++k) {
        const auto place = static_cast<std::size_t>(k);
        EXPECT_LT(std::abs(Complex(dashpot[k], dashpot[k + 3]) - dashpots[place] / elastic), 1e-7);
        EXPECT_LT(std::abs(Complex(relaxation[k], relaxation[k + 3]) - relaxing[place] / elastic), 1e-7);
    }
}

Diagnosis diagnosis_of(const std::vector<Measurement>& tables) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    experiment.measurements = tables;
    return diagnosis_with(399, experiment);
}

const Packing& hidden() {
    static const Packing made = structure(260, 77);
    return made;
}

/// One plate: the bearing brakes as the contacts do. Another plate shows that it does not; only an oil would tell the contacts from
/// a phase that is read late, which the catalogue does not have.
TEST(ContactLosses, ADashpotIsAloneOnceAnotherPlateWasTried) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 20);
    const auto moduli = moduli_of(hidden(), with_dashpots(1e-3), frequencies);
    const Measurement one = sweep(frequencies, moduli, 0.02, 4);
    const Diagnosis tied = diagnosis_of({one});
    EXPECT_TRUE(tied.detected);
    EXPECT_EQ(tied.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(tied, "contact-dashpot"));
    EXPECT_TRUE(in_set(tied, "bearing-damping"));
    EXPECT_FALSE(in_set(tied, "solvent-drag"));
    Measurement wide = sweep(frequencies, moduli, 0.02, 5);
    wide.columns.push_back({"plate_radius", "m", std::vector<double>(frequencies.size(), 0.025)});
    const Diagnosis found = diagnosis_of({one, wide});
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_EQ(names_of(found.credible_set), (std::vector<std::string>{"contact-dashpot", "none of the catalogue"}));
    const EstimatedParameter& time = found.causes.front().parameters[1];
    EXPECT_LT(time.low, 1e-3);
    EXPECT_GT(time.high, 1e-3);
}

/// A few low frequencies do not tell by which way energy is lost in proportion to them.
TEST(ContactLosses, LowFrequenciesTieThem) {
    const std::vector<double> frequencies = logarithmic_steps(0.01, 0.1, 12);
    const Diagnosis found = diagnosis_of({sweep(frequencies, moduli_of(hidden(), with_dashpots(0.3), frequencies), 0.03, 6)});
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "contact-dashpot"));
    EXPECT_TRUE(in_set(found, "contact-relaxation"));
    ASSERT_FALSE(found.proposals.empty());
}

TEST(ContactLosses, ARelaxationIsFoundWhereItsTimeIsPassed) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 20);
    const Diagnosis found =
        diagnosis_of({sweep(frequencies, moduli_of(hidden(), with_relaxation(0.5, 0.05), frequencies), 0.02, 7)});
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_EQ(names_of(found.credible_set), (std::vector<std::string>{"contact-relaxation", "none of the catalogue"}));
    ASSERT_EQ(found.causes.front().parameters.size(), 3U);
    for (const auto& [number, truth] : {std::pair{1U, 0.5}, std::pair{2U, 0.05}}) {
        const EstimatedParameter& one = found.causes.front().parameters[number];
        const double half = 0.5 * (one.high - one.low);
        EXPECT_NEAR(0.5 * (one.low + one.high), truth, 2 * half) << one.name;
        EXPECT_LT(half, 0.1 * truth) << one.name;
    }
}

}  // namespace
}  // namespace coagula::diagnose
