// SPDX-License-Identifier: GPL-3.0-or-later
// Effects hidden in the instrument, the sample's age, the contacts and the microscope: raw torque and angle, positions and steps of
// time by formulas and solvers that the diagnosis does not use, for other structures; the diagnosis sees the table only.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "responses/imaged_centres.hpp"

#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// A structure that the diagnosis does not know.
const Packing& hidden_sample() {
    static const Packing made = structure(260, 77);
    return made;
}

/// The faults of a plate-plate rheometer.
struct Faults {
    double gap_error = 0;  ///< [m]
    double slip = 0;       ///< velocity of the sample at a plate over stress and angular frequency: displacement over stress [m/Pa]
    double compliance = 0;  ///< [rad/(N m)]
    double inertia = 0;     ///< [kg m^2]
};

constexpr double plate_radius = 0.0125;
constexpr double usual_gap = 1e-3;

/// What the rheometer shows for a sample whose rim turns by one unit of angle: torque of the motor over angle of the motor.
Complex shown(Complex modulus, double angular_frequency, double gap, const Faults& faults) {
    const double true_gap = gap + faults.gap_error;
    const Complex rim_stress = modulus * plate_radius / true_gap;
    const Complex torque = rim_stress * pi * std::pow(plate_radius, 3) / 2.0;
    const Complex angle = 1.0 + 2.0 * faults.slip * rim_stress / plate_radius + faults.compliance * torque;
    const Complex motor_torque = torque - faults.inertia * angular_frequency * angular_frequency * angle;
    return motor_torque / angle * 2.0 * gap / (pi * std::pow(plate_radius, 4));
}

/// Modulus of the hidden sample by the frequency solver.
Complex modulus_of(const ContactModel& model, double frequency) {
    const auto response =
        mechanics::solve_frequency_sweep(hidden_sample(), find_contacts(hidden_sample(), 0.01), model, {&frequency, 1});
    return response.points[0].mean_shear_modulus();
}

ContactModel springs(double stiffness) {
    return {.normal_stiffness = stiffness, .shear_stiffness = 0.1 * stiffness};
}

Measurement table_of(MeasurementKind kind, const Column& axis) {
    Measurement table;
    table.kind = kind;
    table.label = "hidden";
    table.sample = "sample";
    table.columns = {axis};
    return table;
}

Measurement gap_series(const Faults& faults, std::uint64_t seed) {
    std::vector<double> gaps = logarithmic_steps(2e-3, 1.5e-4, 14);
    Measurement table = table_of(MeasurementKind::gap_series, {"gap", "m", gaps});
    std::vector<Complex> moduli;
    const Complex modulus = modulus_of(springs(40), 1);
    for (const double gap : gaps) {
        moduli.push_back(shown(modulus, 2 * pi, gap, faults));
    }
    add_moduli(table, moduli, 0.02, seed, false);
    return table;
}

Measurement frequency_sweep(const ContactModel& model, const Faults& faults, std::uint64_t seed) {
    std::vector<double> angular;
    std::vector<Complex> moduli;
    for (const double frequency : logarithmic_steps(100, 0.1, 20)) {  // what is held out are the low ones
        angular.push_back(2 * pi * frequency);
        moduli.push_back(shown(modulus_of(model, frequency), angular.back(), usual_gap, faults));
    }
    Measurement table = table_of(MeasurementKind::frequency_sweep, {"angular_frequency", "rad/s", angular});
    add_moduli(table, moduli, 0.02, seed, true);
    return table;
}

Diagnosis diagnose_tables(const std::vector<Measurement>& tables, Simulator& structures = simulator()) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = plate_radius, .gap = usual_gap};
    experiment.measurements = tables;
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(experiment, structures, options);
}

Diagnosis diagnose_table(const Measurement& table, Simulator& structures = simulator()) {
    return diagnose_tables({table}, structures);
}

void expect_found(const Diagnosis& found, const std::string& name) {
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, name)) << name_of(found.credible_set.front());
    EXPECT_GT(found.gain.rmse_ratio, 2);
}

void expect_named(const Diagnosis& found, const std::string& name) {
    expect_found(found, name);
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{name});
}

/// With the storage modulus of one sample alone, slip, gap and compliance have the same form: 1 / (1 + something / gap).
TEST(HiddenEffects, SlipAtTheWallsIsInTheSet) {
    const Diagnosis found = diagnose_table(gap_series({.slip = 1.5e-10}, 11));
    expect_found(found, "wall-slip");
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "tool-compliance"));
    ASSERT_FALSE(found.proposals.empty());
    EXPECT_NE(found.proposals.front().measurement.find("rough-plates"), std::string::npos);
}

/// At constant strain. @param per_decade by which contacts stiffen.
Measurement ageing_run(double per_decade) {
    const std::vector<double> times = logarithmic_steps(1, 5000, 20);
    std::vector<Complex> moduli;
    for (const double time : times) {
        moduli.push_back(modulus_of(springs(40 * (1 + per_decade * std::log10(1 + time))), 1));
    }
    Measurement table = table_of(MeasurementKind::time_sweep, {"time", "s", times});
    add_moduli(table, moduli, 0.02, 6, false);
    return table;
}

/// Where another effect is hidden beside, what looks like the best cause is tried with the partner that it has found.
TEST(HiddenEffects, LookAlikesAreTriedBesideThePartnerOfTheBest) {
    Measurement setting = ageing_run(0.1);
    setting.sample = "another";
    const Diagnosis found = diagnose_tables({gap_series({.slip = 1.5e-10}, 11), setting});
    for (const std::string cause : {"wall-slip", "tool-compliance", "gap-error"}) {
        EXPECT_TRUE(std::any_of(found.causes.begin(), found.causes.end(), [&](const Cause& one) {
            return one.name() == cause + " + ageing";
        })) << cause;
    }
}

/// What is proposed decides: nothing slips at rough plates.
TEST(HiddenEffects, SlipIsNamedOnceRoughPlatesWereTried) {
    Measurement rough = gap_series({}, 12);
    rough.rough_plates = true;
    rough.sample = "second sample";
    expect_named(diagnose_tables({gap_series({.slip = 1.5e-10}, 11), rough}), "wall-slip");
}

/// An oil shows the gap as it is, and is too soft to turn the tool.
TEST(HiddenEffects, AnErrorOfTheGapIsNamedOnceAnOilWasMeasured) {
    const Faults faults{.gap_error = 5e-5};
    constexpr double viscosity = 1;  // G'' = 6.3 Pa at 1 Hz
    Measurement oil = gap_series(faults, 14);
    oil.sample = "oil";
    oil.fluid_viscosity = viscosity;
    std::vector<double>& moduli = oil.columns[1].values;
    for (std::size_t row = 0; row < moduli.size(); ++row) {
        const Complex seen = shown(Complex(0, 2 * pi * viscosity), 2 * pi, oil.columns[0].values[row], faults);
        moduli[row] = seen.imag() * (1 + 0.02 * drawn_normal(15, row));
        oil.columns[1].standard_errors[row] = 0.02 * seen.imag();
    }
    oil.columns[1].name = "loss_modulus";
    oil.columns.push_back({"angular_frequency", "rad/s", std::vector<double>(moduli.size(), 2 * pi)});
    expect_named(diagnose_tables({gap_series(faults, 2), oil}), "gap-error");
}

TEST(HiddenEffects, AnErrorOfTheGapIsInTheSet) {
    expect_found(diagnose_table(gap_series({.gap_error = 5e-5}, 2)), "gap-error");
}

TEST(HiddenEffects, AToolThatYieldsIsInTheSet) {
    expect_found(diagnose_table(gap_series({.compliance = 5e-3}, 3)), "tool-compliance");
}

TEST(HiddenEffects, InertiaOfTheToolIsNamed) {
    expect_named(diagnose_table(frequency_sweep(springs(40), {.inertia = 4e-5}, 4)), "tool-inertia");
}

/// A modulus alone shows a shear stiffness only where the normal stiffness is known.
TEST(HiddenEffects, ShearStiffnessIsInTheSetWhereTheNormalStiffnessIsKnown) {
    ContactModel model = springs(40);
    model.shear_stiffness = 32;
    Experiment experiment;
    experiment.sample.normal_stiffness = 40;
    experiment.sample.normal_stiffness_error = 0.1;
    experiment.measurements = {frequency_sweep(model, {}, 12)};
    DiagnosisOptions options;
    options.bootstrap = 399;
    const Diagnosis found = diagnose(experiment, simulator(), options);
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "shear-stiffness"));
    ASSERT_FALSE(found.misfits.empty());
    EXPECT_EQ(found.misfits.front().axis, "normal_stiffness");
    EXPECT_GT(found.misfits.front().from, 50);
    const auto& level = std::get<LevelMisfit>(found.misfits.front().what);
    EXPECT_EQ(level.known, 40);
    EXPECT_GT(level.score, 0);
    experiment.measurements = {frequency_sweep(springs(40), {}, 13)};
    EXPECT_FALSE(diagnose(experiment, simulator(), options).detected);
}

/// No cause of the catalogue, but no reason to call anything else by its name, either.
TEST(HiddenEffects, ASampleThatLiesApartIsSaidToDoSo) {
    std::vector<Measurement> sweeps;
    for (std::uint64_t k = 0; k < 4; ++k) {
        sweeps.push_back(frequency_sweep(springs(k == 2 ? 20 : 40), {}, 40 + k));
        sweeps.back().sample = "sample " + std::to_string(k + 1);
    }
    const Diagnosis found = diagnose_tables(sweeps);
    EXPECT_TRUE(found.detected);
    ASSERT_FALSE(found.misfits.empty());
    EXPECT_EQ(found.misfits.front().axis, "sample");
    EXPECT_EQ(found.misfits.front().from, 3);
    EXPECT_EQ(std::get<SampleMisfit>(found.misfits.front().what).sample, "sample 3");
}

/// Inertia where the frequency is high, age where it is low and the sweep has lasted long.
TEST(HiddenEffects, TwoEffectsAreFoundTogether) {
    const std::vector<double> frequencies = logarithmic_steps(100, 0.1, 24);
    const std::vector<double> times = logarithmic_steps(1, 10000, 24);
    std::vector<double> angular;
    std::vector<Complex> moduli;
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
        angular.push_back(2 * pi * frequencies[k]);
        const ContactModel model = springs(40 * (1 + 0.25 * std::log10(1 + times[k])));
        moduli.push_back(shown(modulus_of(model, frequencies[k]), angular.back(), usual_gap, {.inertia = 6e-5}));
    }
    Measurement table = table_of(MeasurementKind::frequency_sweep, {"angular_frequency", "rad/s", angular});
    add_moduli(table, moduli, 0.015, 5, true);
    table.columns.push_back({"time", "s", times});
    expect_found(diagnose_table(table), "tool-inertia + ageing");
}

TEST(HiddenEffects, AgeingAtConstantStrainIsFirst) {
    const Diagnosis found = diagnose_table(ageing_run(0.25));
    expect_found(found, "ageing");
    EXPECT_EQ(found.causes.front().name(), "ageing");
}

Measurement amplitude_sweep(const std::vector<double>& strains, const std::vector<Complex>& moduli, double error,
                            std::uint64_t seed) {
    Measurement table = table_of(MeasurementKind::amplitude_sweep, {"strain", "1", strains});
    add_moduli(table, moduli, error, seed, false);
    return table;
}

/// Hertz contacts by explicit steps. What their rate costs is the same at all strains.
TEST(HiddenEffects, ContactsThatAreNotLinearAreFirst) {
    const std::vector<double> strains = logarithmic_steps(5e-5, 5e-3, 8);
    mechanics::RheometerOptions run;
    run.model = springs(40);
    run.model.young_modulus = 70e9;
    run.model.poisson_ratio = 0.2;
    run.boundary = mechanics::RheometerBoundary::periodic;
    run.growing = false;
    run.oscillations = 2;
    run.steps_per_oscillation = 2000;
    run.compare_with_rest = false;
    const Packing packing = structure(120, 78);
    std::vector<Complex> moduli;
    for (const double strain : strains) {
        run.amplitude = strain;
        const auto result = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, {{1, 0}});
        moduli.emplace_back(result.runs[0].oscillations[1].fundamental_storage);
    }
    const Diagnosis found = diagnose_table(amplitude_sweep(strains, moduli, 0.05, 7));
    expect_found(found, "contact-nonlinearity");
    EXPECT_EQ(found.causes.front().name(), "contact-nonlinearity");
}

/// Designed tie: in one sweep upwards, strain and age rise together, and the modulus rises between what both would make of it.
TEST(HiddenEffects, OneSweepUpwardsTiesAgeAndStrain) {
    const std::vector<double> strains = logarithmic_steps(1e-4, 1e-3, 16);
    const double modulus = modulus_of(springs(40), 1).real();
    std::vector<Complex> moduli;
    for (const double strain : strains) {
        moduli.emplace_back(modulus * std::pow(strain / strains.front(), 0.3));
    }
    Measurement table = amplitude_sweep(strains, moduli, 0.12, 8);
    table.columns.push_back({"time", "s", logarithmic_steps(10, 1000, 16)});
    const Diagnosis found = diagnose_table(table);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "ageing-saturating"));
    EXPECT_TRUE(in_set(found, "contact-nonlinearity"));
    ASSERT_FALSE(found.proposals.empty());
}

/// Centres as a microscope finds them, of a structure that the diagnosis does not know.
Measurement coordinates(double sigma_plane, double sigma_axis, double missed, std::uint64_t seed) {
    return seen_by_microscope(structure(700, 79), sigma_plane, sigma_axis, missed, seed);
}

TEST(HiddenEffects, ErrorsOfLocalisationAreNamed) {
    const Diagnosis found = diagnose_table(coordinates(5e-8, 1.2e-7, 0.05, 9));
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"localisation-error"});
    ASSERT_FALSE(found.misfits.empty());
    EXPECT_EQ(found.misfits.front().axis, "distance");
    const Diagnosis nothing = diagnose_table(coordinates(0, 0, 0, 10));
    EXPECT_FALSE(nothing.detected);
}

/// Centres where no particle is, drawn among those of a structure that the simulation does not know.
TEST(HiddenEffects, FalseParticlesAreCounted) {
    Settings settings;
    settings.localisation_plane = 3e-8;
    settings.localisation_axis = 6e-8;
    settings.missed_share = 0.05;
    settings.false_share = 0.08;
    Measurement table =
        seen_by_microscope(structure(1500, 79), settings.localisation_plane, settings.localisation_axis, settings.missed_share, 11);
    add_false_centres(table, settings.false_share, 0.5e-6, 12);
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.measurements = {table};
    double squares = 0;
    double without = 0;
    Settings all_true = settings;
    all_true.false_share = 0;
    const std::vector<Observation> seen = observations_of(experiment);
    for (const Observation& shell : seen) {
        const double predicted = neighbours(simulator(), settings, shell.row);
        squares += std::pow((shell.value - predicted) / shell.standard_error, 2) / static_cast<double>(seen.size());
        without += std::pow((shell.value - neighbours(simulator(), all_true, shell.row)) / shell.standard_error, 2) /
                   static_cast<double>(seen.size());
    }
    EXPECT_LT(squares, 2);
    EXPECT_GT(without, 3);
    const Diagnosis found = diagnose_table(table);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"localisation-error"});
    const EstimatedParameter& share = found.causes.front().parameters.back();
    EXPECT_EQ(share.name, "false_share");
    EXPECT_LT(share.low, 0.08);
    EXPECT_GT(share.high, 0.08);
}

}  // namespace
}  // namespace coagula::diagnose
