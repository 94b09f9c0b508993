// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that pull at rest: what they do to the modulus, the extended model, and whether the pull is told from stiffer contacts.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "responses/prestress_response.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

Settings under_tension(double tension) {
    Settings settings;
    settings.tension = tension;
    return settings;
}

TEST(Prestress, RaisesTheModulusMostWhereTheNetworkIsLoose) {
    SimulationCache cache;
    Simulator loose({structure(200, 3, 4.4)}, {"loose"}, cache);
    Simulator dense({structure(200, 3, 5.2)}, {"dense"}, cache);
    for (const double tension : {3e-4, 3e-3}) {
        const double raised = prestress_response(simulator(), under_tension(tension));
        EXPECT_GT(raised, 1.02);
        EXPECT_GT(prestress_response(simulator(), under_tension(3 * tension)), raised);
        EXPECT_GT(prestress_response(loose, under_tension(tension)) - 1,
                  1.5 * (prestress_response(dense, under_tension(tension)) - 1));
    }
    EXPECT_EQ(prestress_response(simulator(), Settings{}), 1);
}

TEST(Prestress, CurveAgreesWithTheSolver) {
    for (const double tension : logarithmic_steps(1.3e-4, 8e-3, 4)) {
        EXPECT_NEAR(prestress_response(simulator(), under_tension(tension)) /
                        prestress_response(simulator(), under_tension(tension), 0, true),
                    1, 1e-3);
    }
}

/// Why the cause is a tension: these networks have motions that cost nothing, along which any compression makes them buckle.
TEST(Prestress, CompressionMakesTheNetworkBuckle) {
    const Packing packing = structure(200, 1);
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    ContactModel model = contact_model_of(under_tension(1e-4), 0.25e-6);
    EXPECT_DOUBLE_EQ(model.prestress, -1e-4 * 50 * 0.5e-6);
    model.prestress *= -1;
    mechanics::LinearOptions options;
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
    EXPECT_THROW(mechanics::solve_linear(packing, bonds, options), std::runtime_error);
}

Measurement sweep(const std::vector<std::complex<double>>& moduli, const std::vector<double>& frequencies, double error,
                  std::uint64_t seed) {
    Column frequency{"frequency", "Hz", frequencies};
    Column storage{"storage_modulus", "Pa", {}};
    for (std::size_t k = 0; k < moduli.size(); ++k) {
        const double deviation = error * std::abs(moduli[k]);
        storage.values.push_back(moduli[k].real() + deviation * drawn_normal(seed, k));
        storage.standard_errors.push_back(deviation);
    }
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "hidden";
    table.sample = "sample";
    table.columns = {frequency, storage};
    return table;
}

/// By the frequency solver.
std::vector<std::complex<double>> moduli_of(const Packing& packing, const ContactModel& model,
                                            const std::vector<double>& frequencies) {
    std::vector<std::complex<double>> moduli;
    const auto response = mechanics::solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, frequencies);
    for (const auto& point : response.points) {
        moduli.push_back(point.mean_shear_modulus());
    }
    return moduli;
}

/// With drag, too, which acts on the motions that the tension stiffens.
TEST(Prestress, ExtendedModelRunsToTheSamePrediction) {
    const std::vector<double> frequencies{1, 100};
    Settings settings = under_tension(2e-3);
    settings.normal_stiffness = 55;
    settings.stiffness_ratio = 0.3;
    for (const double viscosity : {0.0, 8.0}) {
        settings.felt_viscosity = viscosity;
        Experiment experiment;
        experiment.measurements = {sweep({1.0, 1.0}, frequencies, 0, 1)};
        const auto rows = observations_of(experiment);
        const Eigen::VectorXd predicted = Forward(experiment, rows, simulator()).predict(settings, true);
        const ContactModel model = contact_model_of(settings, 0.25e-6);
        const auto first = moduli_of(structure(200, 1), model, frequencies);
        const auto second = moduli_of(structure(200, 2), model, frequencies);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double mean = 0.5 * (first[k] + second[k]).real();
            EXPECT_NEAR(predicted[static_cast<Eigen::Index>(k)] / mean, 1, 1e-8) << viscosity;
        }
    }
}

/// Structures enough for the level of the modulus to say something.
Simulator& many_structures() {
    static StoredSimulations stored("four_structures");
    static Simulator made = [] {
        std::vector<Packing> packings;
        std::vector<std::string> names;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            packings.push_back(structure(300, seed));
            names.push_back(std::to_string(seed));
        }
        return Simulator(std::move(packings), std::move(names), stored.results());
    }();
    return made;
}

Diagnosis diagnosis_of(double normal_stiffness, const ContactModel& hidden, std::uint64_t seed) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 16);
    static const Packing sample = structure(600, 77);  // smaller ones differ from each other by more than the tension does
    Experiment experiment;
    experiment.sample.normal_stiffness = normal_stiffness;
    experiment.sample.normal_stiffness_error = std::isfinite(normal_stiffness) ? 0.1 : unset;
    experiment.measurements = {sweep(moduli_of(sample, hidden, frequencies), frequencies, 0.02, seed)};
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(experiment, many_structures(), options);
}

/// Designed tie: where the stiffness of the contacts is known a tension shows, but stiffer contacts raise the modulus alike; where
/// it is not known nothing is wrong with the base model.
TEST(Prestress, IsTiedWithShearStiffnessWhereTheNormalStiffnessIsKnown) {
    Settings settings = under_tension(1e-2);
    settings.normal_stiffness = 40;
    const ContactModel hidden = contact_model_of(settings, 0.25e-6);
    const Diagnosis found = diagnosis_of(40, hidden, 12);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    for (const char* name : {"prestress", "shear-stiffness", "bond-bending"}) {
        EXPECT_TRUE(in_set(found, name)) << name;
    }
    EXPECT_FALSE(diagnosis_of(unset, hidden, 12).detected);
    settings.tension = 0;
    EXPECT_FALSE(diagnosis_of(40, contact_model_of(settings, 0.25e-6), 13).detected);
}

}  // namespace
}  // namespace coagula::diagnose
