// SPDX-License-Identifier: GPL-3.0-or-later
// Effects hidden in a structure series: moduli of structures of several coordinations, by the quasi-static solver, for other
// structures with other seeds than those that the diagnosis knows.
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "responses/amplitude_response.hpp"
#include "responses/linear_modulus.hpp"

#include <coagula/diagnose/power.hpp>
#include <coagula/mechanics/quasistatic.hpp>

#include <gtest/gtest.h>

#include <complex>
#include <optional>

namespace coagula::diagnose {
namespace {

/// The last rows, which are held out, are those of low coordination.
const std::vector<double> coordinations{5.4, 5.0, 4.7, 4.4, 4.15};
constexpr std::size_t structures_per_row = 2;
constexpr double particle_radius = 0.25e-6;

/// The structures that the diagnosis has, some for each row.
struct KnownSeries {
    KnownSeries(const std::string& name, std::vector<Index> sizes) : stored(name) {
        std::vector<Packing> packings;
        std::vector<std::string> names;
        for (std::size_t row = 0; row < coordinations.size(); ++row) {
            for (std::size_t k = 0; k < structures_per_row; ++k) {
                groups.push_back(row + 1);
                packings.push_back(structure(sizes[row % sizes.size()], 100 * row + k + 1, coordinations[row]));
                particles.push_back(static_cast<std::size_t>(packings.back().size()));
                names.push_back(std::to_string(names.size()));
            }
        }
        simulator.emplace(packings, names, stored.results(), Progress{}, groups);
    }
    StoredSimulations stored;
    std::vector<std::size_t> groups;
    std::vector<std::size_t> particles;
    std::optional<Simulator> simulator;
};

KnownSeries& known_series() {
    static KnownSeries made("structure_series", {200});
    return made;
}

/// The structures that were measured, three for each row.
const std::vector<Packing>& measured() {
    static const std::vector<Packing> made = [] {
        std::vector<Packing> all;
        for (std::size_t row = 0; row < coordinations.size(); ++row) {
            for (std::uint64_t k = 0; k < 3; ++k) {
                all.push_back(structure(220, 5000 + 10 * row + k, coordinations[row]));
            }
        }
        return all;
    }();
    return made;
}

/// A table of their moduli, mean of each row, with an error of 3 %; the standard error that it states also covers that a row is the
/// mean of three small structures.
Measurement series(const ContactModel& model, double tolerance, std::uint64_t seed) {
    constexpr double error = 0.03;
    constexpr double stated = 0.1;
    Measurement made;
    made.kind = MeasurementKind::structure_series;
    made.label = "series";
    made.sample = "series";
    Column modulus{"storage_modulus", "Pa", {}};
    double mean = 0;
    for (std::size_t row = 0; row < coordinations.size(); ++row) {
        double sum = 0;
        for (std::size_t k = 3 * row; k < 3 * row + 3; ++k) {
            const Packing& packing = measured()[k];
            for (const double one : mechanics::small_strain_moduli(packing, find_contacts(packing, tolerance), model, 1e-6)) {
                sum += one / 18;
            }
        }
        modulus.values.push_back(sum * (1 + error * drawn_normal(seed, row)));
        mean += sum / static_cast<double>(coordinations.size());
    }
    modulus.standard_errors.assign(coordinations.size(), stated * mean);
    made.columns = {{"coordination", "1", coordinations}, modulus};
    return made;
}

Diagnosis diagnose_series(const Measurement& table, KnownSeries& structures) {
    Experiment experiment;
    experiment.structure_groups = structures.groups;
    experiment.structure_sizes = structures.particles;
    experiment.measurements = {table};
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(experiment, *structures.simulator, options);
}

ContactModel springs(double stiffness) {
    return {.normal_stiffness = stiffness, .shear_stiffness = 0.1 * stiffness};
}

TEST(StructureSeries, FindsNothingWhereNothingIsHidden) {
    EXPECT_FALSE(diagnose_series(series(springs(40), 0.01, 1), known_series()).detected);
}

TEST(StructureSeries, FindsTheBendingOfBonds) {
    ContactModel model = springs(40);
    model.bending_stiffness = model.twisting_stiffness = 0.1 * 20 * particle_radius * particle_radius;
    const Diagnosis found = diagnose_series(series(model, 0.01, 2), known_series());
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "bond-bending"));
    EXPECT_GT(found.gain.rmse_ratio, 2);
}

TEST(StructureSeries, FindsTheRangeOfBonds) {
    const Diagnosis found = diagnose_series(series(springs(40), 0.045, 3), known_series());
    EXPECT_TRUE(found.detected);
    EXPECT_TRUE(in_set(found, "bond-range"));
}

/// Before anyone measures: bending well above the strength that a plan says can be found is found in data of other structures, a
/// hundredth of it is not.
TEST(StructureSeries, PlanSaysWhichBendingItCouldFind) {
    Experiment plan;
    plan.structure_groups = known_series().groups;
    plan.structure_sizes = known_series().particles;
    Measurement table;
    table.kind = MeasurementKind::structure_series;
    table.label = "plan";
    table.columns = {{"coordination", "1", coordinations}};
    plan.measurements = {table};
    PowerOptions options;
    options.causes = {"bond-bending"};
    options.noise.relative = 0.03;
    options.diagnosis.bootstrap = 199;
    options.diagnoses = 0;
    const Power power = find_power(plan, *known_series().simulator, options);
    EXPECT_EQ(power.moduli, coordinations.size());
    EXPECT_NEAR(power.by_chance.count, 0.05 * power.by_chance.of, 4 * std::sqrt(0.05 * 0.95 * power.by_chance.of));
    const CausePower& bending = power.causes.front();
    ASSERT_TRUE(std::isfinite(bending.half.value));
    EXPECT_LT(bending.half.value, 0.3 * bending.range_high);
    const auto found = [&](double strength) {
        ContactModel model = springs(40);
        model.bending_stiffness = model.twisting_stiffness = strength * 20 * particle_radius * particle_radius;
        return diagnose_series(series(model, 0.01, 4), known_series()).detected;
    };
    EXPECT_TRUE(found(bending.range_high));
    EXPECT_FALSE(found(bending.half.value / 100));
}

TEST(StructureSeries, RefusesRowsThatNoStructureStandsFor) {
    Measurement table;
    table.kind = MeasurementKind::structure_series;
    table.columns = {{"coordination", "1", coordinations},
                     {"storage_modulus", "Pa", {1e6, 1e6, 1.1e6, 1.2e6, 1.3e6}},
                     {"structure", "1", {1, 2, 3, 4, 7}}};
    EXPECT_THROW(diagnose_series(table, known_series()), InputError);
}

/// What small structures leave: the standard deviation of repeated draws of a group's mean.
TEST(StructureError, IsTheScatterOfMeansOfDrawnStructures) {
    std::vector<Packing> packings;
    std::vector<std::string> names;
    std::vector<std::size_t> groups;
    for (std::uint64_t k = 0; k < 24; ++k) {
        packings.push_back(structure(150, 900 + k));
        names.push_back(std::to_string(k));
        groups.push_back(k / 4 + 1);
    }
    SimulationCache cache;
    Simulator simulator(packings, names, cache, {}, groups);
    double mean = 0;
    double squared = 0;
    for (std::size_t group = 1; group <= 6; ++group) {
        const double modulus = exact_linear_modulus(simulator, {}, group);
        mean += modulus / 6;
        squared += modulus * modulus / 6;
    }
    const double observed = std::sqrt((squared - mean * mean) * 6 / 5) / mean;
    // Five degrees of freedom against eighteen: a ratio beyond these limits has a probability of 1 %.
    EXPECT_GT(observed / structure_error(simulator, 1), 0.25);
    EXPECT_LT(observed / structure_error(simulator, 1), 2.2);
    const double all = structure_error(simulator, 0) * exact_linear_modulus(simulator, {}, 0);
    EXPECT_NEAR(all / (structure_error(simulator, 1) * exact_linear_modulus(simulator, {}, 1)), std::sqrt(4.0 / 24), 1e-12);
}

/// Two sets of four structures: how far their mean curves of breaking bonds are apart, over the errors that both state.
/// Rows that were not measured leave their numbers out.
TEST(StructureError, GroupsNeedNotFollowEachOther) {
    const auto error_of_last = [](std::size_t last) {
        SimulationCache cache;
        Simulator some({structure(64, 1), structure(64, 2), structure(64, 3), structure(64, 4)}, {"a", "b", "c", "d"}, cache, {},
                       {1, 1, last, last});
        return structure_error(some, last);
    };
    EXPECT_GT(error_of_last(2), 0);
    EXPECT_EQ(error_of_last(7), error_of_last(2));
}

TEST(StructureError, IsWhatMeanCurvesOfYieldDifferBy) {
    Settings settings;
    settings.critical_strain = 1e-4;
    SimulationCache cache;
    const auto set_of = [&](std::uint64_t first) {
        std::vector<Packing> packings;
        std::vector<std::string> names;
        for (std::uint64_t k = first; k < first + 4; ++k) {
            packings.push_back(structure(100, k));
            names.push_back(std::to_string(k));
        }
        return Simulator(packings, names, cache);
    };
    Simulator one = set_of(1);
    Simulator other = set_of(11);
    double squares = 0;
    double parts = 0;
    for (double load = 1.5; load <= 8; load += 0.5) {
        const auto at = [&](Simulator& simulator) {
            return amplitude_response(simulator, settings, (load - 0.5) * settings.critical_strain,
                                      load * settings.critical_strain);
        };
        std::complex<double> variance = 0;  // of G' and of G''
        for (Simulator* simulator : {&one, &other}) {
            const Eigen::VectorXcd mean_and_errors = at(*simulator);
            ASSERT_GT(mean_and_errors.size(), 1);
            for (Index error = 1; error < mean_and_errors.size(); ++error) {
                const std::complex<double> change = mean_and_errors[error] - mean_and_errors[0];
                variance += std::complex(change.real() * change.real(), change.imag() * change.imag());
            }
        }
        const std::complex<double> apart = at(one)[0] - at(other)[0];
        squares += apart.real() * apart.real() / variance.real() + apart.imag() * apart.imag() / variance.imag();
        parts += 2;
    }
    // The parts are so alike along the load that there are about four degrees of freedom: these limits have 1 % beyond them.
    EXPECT_GT(squares / parts, 0.07);
    EXPECT_LT(squares / parts, 3.5);
}

TEST(StructureError, OfYieldIsNotKnownOfOneStructure) {
    SimulationCache cache;
    Settings settings;
    settings.critical_strain = 1e-4;
    Simulator alone({structure(64, 1)}, {"one"}, cache);
    EXPECT_EQ(amplitude_response(alone, settings, 0, 2e-4).size(), 1);
}

/// A level of the modulus within what so few structures leave open is no discrepancy where the stiffness is known, one far beyond
/// is.
TEST(StructureError, OfTheLevelCountsWhereTheStiffnessIsKnown) {
    std::vector<Packing> structures;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        structures.push_back(structure(100, seed));
    }
    SimulationCache cache;
    Simulator simulator(structures, {"1", "2", "3", "4"}, cache);
    Settings truth;
    truth.normal_stiffness = 40;
    const auto is_found = [&](double departure, double sample_effect) {
        const double modulus = exact_linear_modulus(simulator, truth) * std::exp(departure * structure_error(simulator));
        Measurement table;
        table.label = "sweep";
        table.sample = "sample";
        Column storage{"storage_modulus", "Pa", {}};
        for (std::uint64_t row = 0; row < 8; ++row) {
            storage.values.push_back(modulus * (1 + 0.01 * drawn_normal(5, row)));
        }
        storage.standard_errors.assign(8, 0.01 * modulus);
        table.columns = {{"angular_frequency", "rad/s", logarithmic_steps(1, 100, 8)}, storage};
        Experiment experiment;
        experiment.sample.normal_stiffness = truth.normal_stiffness;
        experiment.sample.normal_stiffness_error = 0.01;
        experiment.measurements = {table};
        DiagnosisOptions options;
        options.bootstrap = 199;
        options.causes = {"shear-stiffness"};
        options.errors.sample = sample_effect;
        return diagnose(experiment, simulator, options).detected;
    };
    ASSERT_GT(structure_error(simulator), 0.05) << "the known stiffness itself is hardly better known";
    for (const double sample_effect : {0.01, 0.0}) {
        EXPECT_FALSE(is_found(-1, sample_effect));
        EXPECT_FALSE(is_found(1, sample_effect));
        EXPECT_TRUE(is_found(6, sample_effect)) << sample_effect;
    }
}

}  // namespace
}  // namespace coagula::diagnose
