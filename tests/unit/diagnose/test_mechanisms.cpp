// SPDX-License-Identifier: GPL-3.0-or-later
// Each mechanism, switched on in the simulation, shows the signature that the catalogue claims.
#include "chain/forward.hpp"
#include "data/knows.hpp"
#include "hidden_effects.hpp"
#include "responses/contact_response.hpp"
#include "responses/hertz_scatter.hpp"
#include "responses/linear_modulus.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <coagula/mechanics/hertz_curve.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace coagula::diagnose {
namespace {

/// An amplitude sweep at these strains; the moduli do not matter.
Measurement sweep_at(const std::vector<double>& strains, int run_order) {
    const std::vector<double> ones(strains.size(), 1.0);
    Measurement made;
    made.kind = MeasurementKind::amplitude_sweep;
    made.sample = "one";
    made.run_order = run_order;
    made.columns = {{"strain", "1", strains},
                    {"angular_frequency", "rad/s", ones},
                    {"storage_modulus", "Pa", ones},
                    {"loss_modulus", "Pa", ones}};
    return made;
}

/// A run down again as a table of its own predicts what it does as the second half of one table: broken bonds stay broken.
TEST(BondStrength, IsRememberedInTheNextRunOnTheSample) {
    const std::vector<double> up{1e-5, 1e-4, 3e-4, 5e-4};
    const std::vector<double> down{3e-4, 1e-4, 1e-5};
    std::vector<double> both = up;
    both.insert(both.end(), down.begin(), down.end());
    Settings settings;
    settings.critical_strain = 1e-4;
    Experiment joined;
    joined.measurements = {sweep_at(both, 0)};
    Experiment apart;
    apart.measurements = {sweep_at(up, 0), sweep_at(down, 1)};
    const auto joined_rows = observations_of(joined);
    const auto apart_rows = observations_of(apart);
    for (const bool exact : {false, true}) {
        const Eigen::VectorXd whole = Forward(joined, joined_rows, simulator()).predict(settings, exact);
        const Eigen::VectorXd parts = Forward(apart, apart_rows, simulator()).predict(settings, exact);
        for (Eigen::Index k = 0; k < 3; ++k) {
            EXPECT_NEAR(parts[8 + k] / whole[4 + k], 1, 1e-12) << exact << " " << k;
        }
        EXPECT_LT(parts[10], 0.7 * parts[0]) << "nothing broke";
    }
}

TEST(ContactNonlinearity, StiffensAsTheSquareRootOfTheStrain) {
    Settings settings;
    settings.contact_preload = 1e-5;
    const auto at = [&](double load) { return contact_response(simulator(), settings, load * settings.contact_preload); };
    const double fifty = at(50);
    EXPECT_NEAR(at(0.1) / at(0.2), 1, 0.01);              // linear below the overlap at rest
    EXPECT_LT(at(1), at(0.1));                            // where half of the contacts are relieved
    EXPECT_NEAR(at(1000) / at(100), std::sqrt(10), 0.1);  // the load at rest is not quite forgotten
    EXPECT_NEAR(at(100000) / at(1000), 10, 0.1);
    settings.contact_preload = 2e-5;
    EXPECT_DOUBLE_EQ(at(50), fifty);
    settings.contact_preload = 0;
    EXPECT_EQ(contact_response(simulator(), settings, 1e-3), 1);
}

TEST(ContactNonlinearity, IsTheLinearSolversModulusAtSmallStrain) {
    Settings settings;
    settings.contact_preload = 1e-4;
    ContactModel model = contact_model_of(settings, 0.25e-6);
    const double overlap = 1e-4 * 0.25e-6;
    model.prestress = 2.0 / 3 * 50 * overlap;  // stiffness 3/2 force / overlap
    double hertz = 0;
    double springs = 0;
    for (const std::uint64_t seed : {1U, 2U}) {
        const Packing packing = structure(200, seed);
        const ContactNetwork bonds = find_contacts(packing, 0.01);
        mechanics::LinearOptions options;
        springs += mechanics::solve_linear(packing, bonds, options).mean_shear_modulus();
        options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
        for (ContactTangent& tangent : options.bond_tangents) {
            EXPECT_NEAR(tangent.normal, 50, 1e-9);
            tangent.tension = 0;  // the force that balances the load bears the opposite
        }
        hertz += mechanics::solve_linear(packing, bonds, options).mean_shear_modulus();
    }
    EXPECT_NEAR(contact_response(simulator(), settings, 1e-6) / (hertz / springs), 1, 0.005);
}

std::vector<double> hertz_curve_of(const Packing& packing, const std::vector<double>& loads) {
    constexpr double preload = 1e-4;
    Settings settings;
    settings.contact_preload = preload;
    const ContactModel contact = contact_model_of(settings, mean_radius(packing));
    return mechanics::hertz_curve(packing, find_contacts(packing, 0.01), contact, preload, loads);
}

/// Newton's method in steps of a 24th of a decade, in three planes and both directions
/// (tests/benchmark/diagnosis_campaign/hertz.py), of the same places.
TEST(ContactNonlinearity, IsThatOfSmallStepsByNewtonsMethod) {
    const std::vector<double> by_newton{1, 0.9982, 0.9918, 0.9668, 0.9311, 0.9461, 1.0563, 1.2724, 1.6029, 2.0701, 2.7270, 3.6152};
    std::vector<double> loads;
    for (int node = 0; node < hertz_axis.count; ++node) {
        loads.push_back(hertz_axis.node(node));
    }
    const Packing packing = structure(100, 3);
    const std::vector<double> curve = hertz_curve_of(packing, loads);
    for (std::size_t node = 0; node < loads.size(); ++node) {
        EXPECT_NEAR(curve[node] / curve.front() / by_newton[node], 1, 0.01) << loads[node];
    }
}

/// Turned and mirrored, a structure is sheared in other planes and in the other direction.
TEST(ContactNonlinearity, OfAStructureDoesNotDependOnHowItLies) {
    Packing packing = structure(100, 3);
    const std::vector<double> loads{1.0, 5.0, 50.0};
    const std::vector<double> given = hertz_curve_of(packing, loads);
    const Packing before = packing;
    packing.positions.row(0) = before.positions.row(1);
    packing.positions.row(1) = before.cell.lengths().x() - before.positions.row(0).array();
    const std::vector<double> turned = hertz_curve_of(packing, loads);
    for (std::size_t node = 0; node < loads.size(); ++node) {
        EXPECT_NEAR(turned[node], given[node], 2e-3 * given[node]) << loads[node];
    }
}

/// Hertz contacts without load at rest in the explicit rheometer: what its rate costs is in both strains.
TEST(ContactNonlinearity, AgreesWithExplicitSteps) {
    const Packing packing = structure(100, 3);
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    mechanics::RheometerOptions run;
    Settings settings;
    settings.contact_preload = 1e-5;
    run.model = contact_model_of(settings, 0.25e-6);
    run.model.prestress = unset;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.growing = false;
    run.oscillations = 2;
    run.steps_per_oscillation = 20000;
    run.compare_with_rest = false;
    const auto storage = [&](double amplitude) {
        run.amplitude = amplitude;
        return mechanics::run_rheometer(packing, bonds, run, {{2, 1}}).runs[0].oscillations[1].fundamental_storage;
    };
    SimulationCache cache;
    Simulator alone({packing}, {"alone"}, cache);
    const double linear = mechanics::solve_linear(packing, bonds).elastic_tensor(3, 3);
    const double small = storage(1e-3);
    const double large = storage(1e-2);
    // Unloading keeps the shear displacement and so loses shear force, which the secants of loading do not.
    EXPECT_NEAR(large / linear / contact_response(alone, settings, 1e-2), 0.9, 0.1);
    EXPECT_NEAR(large / small, std::sqrt(10), 0.25);
}

/// The prediction departs the more the fewer particles a structure has, and not at all without drift.
TEST(Numerical, DriftsWithTheNumberOfParticles) {
    Experiment experiment;
    experiment.structure_groups = {1, 2};
    Measurement table;
    table.kind = MeasurementKind::structure_series;
    table.columns = {{"coordination", "1", {4.7, 4.7}}, {"storage_modulus", "Pa", {1e6, 1e6}}};
    experiment.measurements = {table};
    SimulationCache cache;
    Simulator two({structure(64, 1), structure(512, 2)}, {"small", "large"}, cache, {}, experiment.structure_groups);
    const std::vector<Observation> observations = observations_of(experiment);
    const Forward forward(experiment, observations, two);
    Settings settings;
    const Eigen::VectorXd base = forward.predict(settings);
    EXPECT_NEAR(base[0], exact_linear_modulus(two, settings, 1), 1e-9 * base[0]);
    EXPECT_NEAR(base[1], exact_linear_modulus(two, settings, 2), 1e-9 * base[1]);
    const Model drifting({find_mechanism("numerical")}, std::array{0.2});
    const Eigen::ArrayXd departure = forward.predict(drifting).array() / base.array() - 1;
    EXPECT_NEAR(departure[0], 0.5, 1e-9);
    EXPECT_NEAR(departure[1], 0.25, 1e-9);
}

/// One frequency under a cone.
Experiment under_cone(double radius, double angle) {
    Experiment made;
    made.instrument = {.geometry = Geometry::cone_plate, .plate_radius = radius, .cone_angle = angle};
    Measurement table = sweep_at({1e-5}, 0);
    table.kind = MeasurementKind::frequency_sweep;
    made.measurements = {table};
    return made;
}

std::complex<double> first_modulus(const Experiment& experiment, const Model& model) {
    const auto rows = observations_of(experiment);
    const Eigen::VectorXd predicted = Forward(experiment, rows, simulator()).predict(model);
    return {predicted[0], predicted[1]};
}

/// The torque against a sum over rings, each with the gap at its radius; for small slip, much, and where the formula changes.
TEST(WallSlip, UnderAConeIsThatOfTheGapAtEveryRadius) {
    constexpr double radius = 0.0125;
    constexpr double angle = 0.02;
    Experiment experiment = under_cone(radius, angle);
    EXPECT_TRUE(find_mechanism("wall-slip")->applies(knowledge_of(experiment)));
    Settings settings;
    settings.springpot_ratio = 1;
    settings.springpot_exponent = 0.3;
    const std::complex<double> modulus = first_modulus(experiment, settings);
    EXPECT_GT(modulus.imag(), 0.1 * modulus.real());
    Model slipping(settings);
    for (const double sliding : {1e-4, 0.1, 3.0, 49.0, 51.0, 1e4}) {  // at both walls, over the sample's own at the rim
        const double slip = sliding * angle * radius / (2 * std::abs(modulus));
        slipping.acting = {{find_mechanism("wall-slip"), {slip}}};
        constexpr int rings = 20000;
        std::complex<double> torque = 0;
        for (int ring = 0; ring < rings; ++ring) {
            const double r = radius * (ring + 0.5) / rings;
            const std::complex<double> stress = modulus / (1.0 + 2.0 * slip * modulus / (angle * r));
            torque += 3.0 / rings * std::pow(r / radius, 2) * stress;
        }
        EXPECT_LT(std::abs(first_modulus(experiment, slipping) / torque - 1.0), 1e-7) << sliding;
    }
    experiment.measurements[0].rough_plates = true;
    EXPECT_EQ(first_modulus(experiment, slipping), modulus);
    experiment.instrument.plate_radius = unset;
    EXPECT_FALSE(find_mechanism("wall-slip")->applies(knowledge_of(experiment)));
}

/// What a pair says of one cause is not lost behind the other.
TEST(Catalogue, ParametersHaveNamesOfTheirOwn) {
    std::set<std::string> names{"normal_stiffness"};
    for (const Mechanism& mechanism : catalogue()) {
        for (const MechanismParameter& parameter : mechanism.parameters) {
            EXPECT_TRUE(names.insert(parameter.name).second) << mechanism.name << ": " << parameter.name;
        }
    }
}

/// Moduli at one strain against frequency, with this mechanism and without, between plates of 12.5 mm and 1 mm.
std::vector<std::complex<double>> tool_changes(const char* name, double value, const std::vector<double>& frequencies) {
    Experiment experiment;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    Measurement table;
    table.columns = {{"angular_frequency", "rad/s", frequencies},
                     {"storage_modulus", "Pa", std::vector(frequencies.size(), 1.0)},
                     {"loss_modulus", "Pa", std::vector(frequencies.size(), 1.0)}};
    experiment.measurements = {table};
    EXPECT_TRUE(find_mechanism(name)->applies(knowledge_of(experiment)));
    const auto rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const Eigen::VectorXd with = forward.predict(Model({find_mechanism(name)}, std::array{value}));
    const Eigen::VectorXd without = forward.predict(Model{});
    std::vector<std::complex<double>> changes;
    const auto count = static_cast<Index>(frequencies.size());
    for (Index row = 0; row < count; ++row) {
        changes.emplace_back(with[row] - without[row], with[row + count] - without[row + count]);
    }
    return changes;
}

/// T = (K G* + i b w) theta with K = pi R^4 / (2 h).
TEST(BearingDamping, AddsToTheLossModulusInProportionToTheFrequency) {
    const std::vector<double> frequencies{0.5, 5, 50};
    const auto changes = tool_changes("bearing-damping", 1e-6, frequencies);
    for (std::size_t row = 0; row < frequencies.size(); ++row) {
        const double expected = 1e-6 * frequencies[row] * 2 * 1e-3 / (std::numbers::pi * std::pow(0.0125, 4));
        EXPECT_NEAR(changes[row].imag(), expected, 1e-9 * expected);
        EXPECT_EQ(changes[row].real(), 0);
    }
}

/// Of springs, which lose nothing, G'' is tan(offset) times G'.
TEST(PhaseOffset, TurnsTheModulus) {
    const double modulus = linear_modulus(simulator(), {});
    for (const double offset : {0.015, -0.015}) {
        for (const std::complex<double>& change : tool_changes("phase-offset", offset, {0.5, 50})) {
            EXPECT_LT(std::abs(change - modulus * (std::polar(1.0, offset) - 1.0)), 1e-9 * modulus);
        }
    }
}

/// At both ends of their priors.
TEST(ExtendedModel, IsAcceptedForEveryPairInTheContact) {
    const auto values_at = [](const Hypothesis& hypothesis, bool low, bool high) {
        std::vector<double> values;
        for (const Mechanism* mechanism : hypothesis) {
            for (const MechanismParameter& parameter : mechanism->parameters) {
                values.push_back(parameter.at((mechanism == hypothesis[0] ? low : high) ? 1 : 0));
            }
        }
        return values;
    };
    std::size_t pairs = 0;
    for (const Mechanism& first : catalogue()) {
        for (const Mechanism& second : catalogue()) {
            for (const int place : {0, 1, 2, 3}) {
                if (!first.in_contact || !second.in_contact || &first == &second) {
                    continue;
                }
                const Hypothesis both{&first, &second};
                const Model model(both, values_at(both, place >= 2, place % 2 == 1));
                EXPECT_NO_THROW(check(contact_model_of(model, 0.25e-6))) << name_of(both);
                ++pairs;
            }
        }
    }
    EXPECT_GT(pairs, 100);
}

/// Bonds under tension bear, beyond it, what they would bear without.
TEST(ExtendedModel, StrengthIsCountedFromTheTensionAtRest) {
    Settings settings;
    settings.critical_strain = 1e-3;
    const double alone = contact_model_of(settings, 0.25e-6).normal_strength;
    settings.tension = 1e-2;
    const ContactModel model = contact_model_of(settings, 0.25e-6);
    EXPECT_NEAR(model.normal_strength + model.prestress, alone, 1e-12 * model.normal_strength);
}

}  // namespace
}  // namespace coagula::diagnose
