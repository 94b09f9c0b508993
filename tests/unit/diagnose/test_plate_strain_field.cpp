// SPDX-License-Identifier: GPL-3.0-or-later
// Breaking bonds under the strain field of parallel plates: the law of the torque against an integral over many radii, and data
// from explicit runs at many radii of another structure.
#include "chain/forward.hpp"
#include "data/knows.hpp"
#include "hidden_effects.hpp"
#include "responses/amplitude_response.hpp"
#include "responses/linear_modulus.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include <set>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

/// An amplitude sweep between these tools; the moduli are those given, with standard errors as a part of the largest.
Experiment sweep(const std::vector<double>& strains, const std::vector<Complex>& moduli, Geometry geometry, double error = 0,
                 std::uint64_t seed = 1) {
    Column storage{"storage_modulus", "Pa", {}};
    Column loss{"loss_modulus", "Pa", {}};
    for (std::size_t k = 0; k < strains.size(); ++k) {
        const double deviation = error * std::abs(moduli.front());
        storage.values.push_back(moduli[k].real() + deviation * drawn_normal(seed, 2 * k));
        loss.values.push_back(moduli[k].imag() + deviation * drawn_normal(seed, 2 * k + 1));
        storage.standard_errors.push_back(deviation);
        loss.standard_errors.push_back(deviation);
    }
    Measurement table;
    table.kind = MeasurementKind::amplitude_sweep;
    table.label = "hidden";
    table.sample = "sample";
    table.columns = {{"strain", "1", strains}, storage, loss};
    Experiment made;
    made.instrument.geometry = geometry;
    made.measurements = {table};
    return made;
}

/// G* over G of the rows of a sweep.
std::vector<Complex> response(const std::vector<double>& strains, const Settings& settings, Geometry geometry, bool exact = false,
                              double cone_angle = unset) {
    Experiment experiment = sweep(strains, std::vector<Complex>(strains.size(), 1.0), geometry);
    experiment.measurements[0].cone_angle = cone_angle;
    const auto rows = observations_of(experiment);
    const Eigen::VectorXd predicted = Forward(experiment, rows, simulator()).predict(settings, exact);
    const double linear = exact ? exact_linear_modulus(simulator(), settings) : linear_modulus(simulator(), settings);
    std::vector<Complex> responses(strains.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double value = predicted[static_cast<Eigen::Index>(k)] / linear;
        responses[rows[k].row] += is_loss(rows[k]) ? Complex(0, value) : Complex(value, 0);
    }
    return responses;
}

Settings weak(double Settings::*critical) {
    Settings settings;
    settings.*critical = 2e-4;
    return settings;
}

TEST(PlateStrainField, IsTheIntegralOverTheTorque) {
    const Settings uniform = weak(&Settings::critical_strain);
    const std::vector<double> strains = logarithmic_steps(2e-5, 1.5e-3, 14);
    const std::vector<Complex> between_plates = response(strains, weak(&Settings::rim_critical_strain), Geometry::plate_plate);
    for (std::size_t k = 0; k < strains.size(); ++k) {
        constexpr int radii = 2000;
        Complex torque = 0;  // 4 times the integral of G*(gamma_R x) x^3 over x
        for (int ring = 0; ring < radii; ++ring) {
            const double x = (ring + 0.5) / radii;
            torque += 4.0 / radii * std::pow(x, 3) *
                      amplitude_response(simulator(), uniform, k > 0 ? x * strains[k - 1] : 0, x * strains[k])[0];
        }
        EXPECT_LT(std::abs(between_plates[k] - torque), 0.005) << strains[k];
    }
}

/// Strain at which the storage modulus has fallen to a part of the linear one, over those of a sweep.
double yield(const std::vector<double>& strains, const std::vector<Complex>& responses, double part) {
    std::size_t k = 1;
    while (responses.at(k).real() > part) {
        ++k;
    }
    const double past = (responses[k - 1].real() - part) / (responses[k - 1].real() - responses[k].real());
    return strains[k - 1] * std::pow(strains[k] / strains[k - 1], past);
}

TEST(PlateStrainField, BroadensTheYieldAndPutsItOffAtTheRim) {
    const std::vector<double> strains = logarithmic_steps(2e-5, 1.5e-3, 30);
    const auto uniform = response(strains, weak(&Settings::critical_strain), Geometry::plate_plate);
    const auto field = response(strains, weak(&Settings::rim_critical_strain), Geometry::plate_plate);
    EXPECT_GT(yield(strains, field, 0.6), 1.05 * yield(strains, uniform, 0.6));
    EXPECT_GT(yield(strains, field, 0.6) / yield(strains, field, 0.9),
              1.05 * yield(strains, uniform, 0.6) / yield(strains, uniform, 0.9));
}

/// A cone of the instrument, or in place of the upper plate for one table.
TEST(PlateStrainField, IsNotThereUnderACone) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-3, 8);
    for (const bool exact : {false, true}) {
        const auto uniform = response(strains, weak(&Settings::critical_strain), Geometry::plate_plate, exact);
        const auto cone = response(strains, weak(&Settings::rim_critical_strain), Geometry::cone_plate, exact);
        const auto exchanged = response(strains, weak(&Settings::rim_critical_strain), Geometry::plate_plate, exact, 0.02);
        for (std::size_t k = 0; k < strains.size(); ++k) {
            EXPECT_LT(std::abs(cone[k] - uniform[k]), 1e-12) << strains[k];
            EXPECT_LT(std::abs(exchanged[k] - uniform[k]), 1e-12) << strains[k];
        }
    }
    Experiment experiment = sweep(strains, std::vector<Complex>(strains.size(), 1.0), Geometry::plate_plate);
    EXPECT_TRUE(find_mechanism("plate-strain-field")->applies(knowledge_of(experiment)));
    experiment.measurements[0].cone_angle = 0.02;
    EXPECT_FALSE(find_mechanism("plate-strain-field")->applies(knowledge_of(experiment)));
}

/// Torque per angle over the modulus is that of the cone, and no gap matters.
TEST(PlateStrainField, AConeInPlaceOfThePlateTurnsByItsAngle) {
    constexpr double radius = 0.0125;
    constexpr double angle = 0.02;
    Experiment experiment = sweep({1e-5}, {1.0}, Geometry::plate_plate);
    experiment.instrument.plate_radius = radius;
    experiment.instrument.gap = 1e-3;
    experiment.measurements[0].cone_angle = angle;
    const auto rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const double modulus = forward.predict(Model{})[0];
    EXPECT_DOUBLE_EQ(forward.predict(Model({find_mechanism("gap-error")}, std::array{1e-4}))[0], modulus);
    const Model yielding({find_mechanism("gap-error"), find_mechanism("tool-compliance")}, std::array{1e-4, 0.01});
    const double factor = 2 * std::numbers::pi * std::pow(radius, 3) / (3 * angle);
    EXPECT_NEAR(forward.predict(yielding)[0], modulus / (1 + 0.01 * factor * modulus), 1e-9 * modulus);
}

/// Without its angle nothing is known of what a cone transmits.
TEST(PlateStrainField, AConeWithoutAnAngleShowsNothingOfTheTool) {
    Experiment experiment = sweep({1e-5, 1e-4}, {1.0, 1.0}, Geometry::cone_plate);
    experiment.instrument.plate_radius = 0.0125;
    experiment.instrument.gap = 5e-5;
    EXPECT_FALSE(find_mechanism("tool-compliance")->applies(knowledge_of(experiment)));
    experiment.instrument.cone_angle = 0.02;
    experiment.instrument.gap = unset;  // which matters between plates only
    EXPECT_TRUE(find_mechanism("tool-compliance")->applies(knowledge_of(experiment)));
    const std::vector<Observation> observations = observations_of(experiment);
    const Forward forward(experiment, observations, simulator());
    const Model yielding({find_mechanism("tool-compliance")}, std::array{5e-3});
    const double modulus = forward.predict(Model{})[0];
    const double torque = 2 * std::numbers::pi * std::pow(0.0125, 3) / (3 * 0.02) * modulus;
    EXPECT_NEAR(forward.predict(yielding)[0] / modulus, 1 / (1 + 5e-3 * torque), 1e-12);
    experiment.instrument.geometry = Geometry::plate_plate;
    EXPECT_FALSE(find_mechanism("tool-compliance")->applies(knowledge_of(experiment)));
}

/// The weaker of the two strengths breaks the bonds, and the extended model has that one.
TEST(PlateStrainField, TheSmallerStrengthCounts) {
    const std::vector<double> strains = logarithmic_steps(2e-5, 1.5e-3, 8);
    Settings both = weak(&Settings::rim_critical_strain);
    const auto field = response(strains, both, Geometry::plate_plate);
    both.critical_strain = 5e-4;
    EXPECT_EQ(response(strains, both, Geometry::plate_plate), field);
    EXPECT_DOUBLE_EQ(contact_model_of(both, 0.25e-6).normal_strength, 2e-4 * 50 * 0.25e-6);
}

/// The run at the strains at the rim, from which the rings follow, against runs of ten other rings.
TEST(PlateStrainField, TheRunAtTheRimServesTheRings) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-3, 8);
    const auto between_plates = response(strains, weak(&Settings::rim_critical_strain), Geometry::plate_plate, true);
    std::vector<Complex> torque(strains.size());
    constexpr int radii = 10;
    for (int ring = 0; ring < radii; ++ring) {
        std::vector<double> local = strains;
        for (double& strain : local) {
            strain *= (ring + 0.5) / radii;
        }
        const double weight = std::pow((ring + 1.0) / radii, 4) - std::pow(static_cast<double>(ring) / radii, 4);
        const auto run = exact_amplitude_response(simulator(), weak(&Settings::critical_strain), local);
        for (std::size_t k = 0; k < strains.size(); ++k) {
            torque[k] += weight * run[k].first;
        }
    }
    EXPECT_LT(torque.back().real(), 0.8);
    for (std::size_t k = 0; k < strains.size(); ++k) {
        EXPECT_LT(std::abs(between_plates[k] - torque[k]), 0.02) << strains[k] << between_plates[k] << torque[k];
    }
}

/// What was simulated for one fit serves those whose strength is the same to half a hundredth.
TEST(PlateStrainField, StrengthsEndAtHundredths) {
    for (const char* name : {"plate-strain-field", "bond-strength"}) {
        const MechanismParameter& strain = find_mechanism(name)->parameters[0];
        const auto rounded = [&](double value) { return strain.at(strain.rounded(strain.place_of(value))); };
        const double middle = rounded(2e-4);
        EXPECT_NEAR(middle / 2e-4, 1, 0.0051);
        EXPECT_EQ(rounded(1.0045 * middle), middle);
        EXPECT_EQ(rounded(0.9955 * middle), middle);
        EXPECT_NEAR(rounded(1.0055 * middle) / middle, 1.01, 1e-4);
    }
}

/// Explicit runs of another structure, at other orientations, damping and step than the diagnosis uses; between plates at ten radii
/// with equal steps.
std::vector<Complex> torque_of_runs(const std::vector<double>& strains, double critical_strain, bool under_cone = false) {
    const Packing sample = structure(250, 77);
    const ContactNetwork bonds = find_contacts(sample, 0.01);
    mechanics::RheometerOptions run;
    run.model = {.normal_stiffness = 40, .shear_stiffness = 4};
    run.model.normal_strength = run.model.shear_strength = critical_strain * 20 * 0.25e-6;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.oscillations = static_cast<int>(strains.size()) + 2;
    run.steps_per_oscillation = 4000;
    run.damping = 0.7;
    run.compare_with_rest = false;
    run.course.assign(2, {1e-3});
    for (const double strain : strains) {
        run.course.push_back({strain / strains.back()});
    }
    const int radii = under_cone ? 1 : 10;
    std::vector<Complex> moduli(strains.size());
    for (int ring = 0; ring < radii; ++ring) {
        const double x = under_cone ? 1 : (ring + 0.5) / radii;
        const double weight = std::pow((ring + 1.0) / radii, 4) - std::pow(static_cast<double>(ring) / radii, 4);
        run.amplitude = x * strains.back();
        const auto oscillations = mechanics::run_rheometer(sample, bonds, run, {{2, 0}}).runs.front().oscillations;
        for (std::size_t k = 0; k < strains.size(); ++k) {
            moduli[k] += weight * Complex(oscillations[k + 2].fundamental_storage,
                                          oscillations[k + 2].fundamental_loss - oscillations[1].fundamental_loss);
        }
    }
    return moduli;
}

/// Two structures of 200 particles do not know well enough how a sample yields to tell the field from breaking at once, however
/// small the errors of the data are.
TEST(PlateStrainField, IsTiedWithBreakingAtOnceWhereStructuresAreFew) {
    const std::vector<double> strains = logarithmic_steps(5e-5, 2.4e-3, 16);
    const Experiment measured = sweep(strains, torque_of_runs(strains, 2e-4), Geometry::plate_plate, 0.03, 3);
    DiagnosisOptions options;
    options.bootstrap = 399;
    const Diagnosis found = diagnose(measured, simulator(), options);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    const std::vector<std::string> names = names_of(found.credible_set);
    EXPECT_EQ((std::set<std::string>{names.begin(), names.end()}), (std::set<std::string>{"plate-strain-field", "bond-strength"}));
    EXPECT_GT(found.gain.rmse_ratio, 2);
    const auto field = std::find_if(found.causes.begin(), found.causes.end(),
                                    [](const Cause& cause) { return cause.name() == "plate-strain-field"; });
    ASSERT_NE(field, found.causes.end());
    EXPECT_LT(field->parameters[1].low, 2e-4);
    EXPECT_GT(field->parameters[1].high, 2e-4);
    const MechanismParameter& strain = find_mechanism("plate-strain-field")->parameters[0];
    const double place = strain.place_of(field->model.simulated().rim_critical_strain);
    EXPECT_NEAR(place, strain.rounded(place), 1e-9) << "strengths end at hundredths";

    // What is proposed decides.
    ASSERT_FALSE(found.proposals.empty());
    EXPECT_EQ(found.proposals.front().measurement, "amplitude-sweep-under-cone");
    const auto same = std::find_if(found.proposals.begin(), found.proposals.end(),
                                   [](const Proposal& one) { return one.measurement == "amplitude-sweep"; });
    ASSERT_NE(same, found.proposals.end());
    EXPECT_LT(same->information, 0.1) << "what the structures leave open stays open";
    Measurement cone = sweep(strains, torque_of_runs(strains, 2e-4, true), Geometry::plate_plate, 0.03, 4).measurements[0];
    cone.sample = "under the cone";
    cone.cone_angle = 0.02;
    Experiment both = measured;
    both.measurements.push_back(cone);
    const Diagnosis decided = diagnose(both, simulator(), options);
    EXPECT_EQ(decided.verdict, Verdict::named);
    EXPECT_EQ(names_of(decided.credible_set), std::vector<std::string>{"plate-strain-field"});
}

}  // namespace
}  // namespace coagula::diagnose
