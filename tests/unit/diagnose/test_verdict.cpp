// SPDX-License-Identifier: GPL-3.0-or-later
// The two levels of the verdict: what the data follow, and whether a cause may have a name. The effects here are formulas that no
// cause has, or that lie far outside of the range of one.
#include <coagula/diagnose/diagnosis.hpp>

#include <coagula/common/logarithmic_steps.hpp>

#include "credible_set.hpp"
#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

constexpr double gel = 6e5;        // Pa
constexpr double relative = 0.02;  // errors of G', and of G'' over |G*|
constexpr double plate_radius = 0.0125;
constexpr double plate_gap = 1e-3;

struct Row {
    double strain;
    double angular_frequency;
    double time;
    char sample;
};
using Effect = std::function<std::complex<double>(const Row& row)>;

Measurement measured(MeasurementKind kind, char sample, const std::vector<double>& strains, const std::vector<double>& frequencies,
                     double seconds, const Effect& modulus, std::uint64_t seed) {
    Measurement table;
    table.kind = kind;
    table.label = std::string("table ") + sample + std::to_string(seed);
    table.sample = std::string(1, sample);
    Column strain{"strain", "1", strains};
    Column frequency{"angular_frequency", "rad/s", frequencies};
    Column time{"time", "s", {}};
    Column storage{"storage_modulus", "Pa", {}};
    Column loss{"loss_modulus", "Pa", {}};
    for (std::size_t row = 0; row < strains.size(); ++row) {
        time.values.push_back(seconds * static_cast<double>(row + 1));
        const std::complex<double> value = modulus({strains[row], frequencies[row], time.values.back(), sample});
        const double error = relative * std::abs(value);
        storage.values.push_back(value.real() + error * drawn_normal(seed, 2 * row));
        loss.values.push_back(value.imag() + error * drawn_normal(seed, 2 * row + 1));
        storage.standard_errors.push_back(error);
        loss.standard_errors.push_back(error);
    }
    table.columns = {strain, frequency, time, storage, loss};
    return table;
}

const std::vector<double> frequencies = logarithmic_steps(0.5, 200, 12);
const std::vector<double> one_frequency(12, 2 * std::numbers::pi);
const std::vector<double> strains = logarithmic_steps(1e-5, 4e-4, 12);
const std::vector<double> small_strain(12, 1e-5);

/// A sweep on each of three samples, 40 s a row.
Experiment sweeps(MeasurementKind kind, const Effect& modulus, std::uint64_t seed = 100) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = plate_radius, .gap = plate_gap};
    for (const char sample : {'A', 'B', 'C'}) {
        experiment.measurements.push_back(measured(kind, sample, kind == MeasurementKind::amplitude_sweep ? strains : small_strain,
                                                   kind == MeasurementKind::frequency_sweep ? frequencies : one_frequency, 40,
                                                   modulus, ++seed));
    }
    return experiment;
}

Diagnosis verdict_on(const Experiment& experiment) {
    DiagnosisOptions options;
    options.bootstrap = 199;
    options.errors.sample = 0.02;
    return diagnose(experiment, simulator(), options);
}

double per_torque() {
    return 2 * plate_gap / (std::numbers::pi * std::pow(plate_radius, 4));
}

/// A name, its conditions and its set say the same, whatever the verdict.
void expect_consistent(const Diagnosis& found) {
    const bool all = std::all_of(found.conditions.begin(), found.conditions.end(), [](const Condition& one) { return one.holds; });
    if (found.verdict == Verdict::named) {
        EXPECT_TRUE(all);
        EXPECT_EQ(found.credible_set.size(), 1U);
        EXPECT_GT(found.causes.front().posterior, 0.94);
    }
    if (found.detected && !all) {
        EXPECT_NE(found.verdict, Verdict::named);
        EXPECT_TRUE(in_set(found, "none of the catalogue"));
        EXPECT_TRUE(found.causes.front().name() == "none of the catalogue" || found.causes.front().posterior < 0.95);
    }
    EXPECT_EQ(found.detected, found.verdict != Verdict::no_discrepancy);
    double sum = 0;
    for (const FollowedKind& kind : found.kinds) {
        sum += kind.posterior;
    }
    EXPECT_NEAR(sum, found.detected ? 1 : 0, 1e-9);
}

std::string kind_of(const Diagnosis& found) {
    return std::string(name_of(found.follows.kind.link)) + " along " + name_of(found.follows.kind.axis);
}

TEST(Verdict, NamesACauseOfTheCatalogueWhereAllHolds) {
    const Diagnosis found = verdict_on(sweeps(MeasurementKind::frequency_sweep, [](const Row& row) {
        return std::complex<double>(gel - 3e-4 * row.angular_frequency * row.angular_frequency * per_torque(), 0);
    }));
    expect_consistent(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"tool-inertia"});
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(kind_of(found), "tool along frequency");
    EXPECT_GT(found.follows.posterior, 0.95);
    EXPECT_LT(found.follows.change, -0.05);
}

/// A constant torque in phase with the angle, as of a contact line: the more of a stress, the smaller the strain.
TEST(Verdict, ATorqueThatStaysMayBeOfTheToolAlongTheStrain) {
    const Diagnosis found = verdict_on(sweeps(
        MeasurementKind::amplitude_sweep, [](const Row& row) { return std::complex<double>(gel * (1 + 4e-6 / row.strain), 0); }));
    expect_consistent(found);
    EXPECT_TRUE(found.detected);
    EXPECT_LT(found.follows.posterior, 0.9) << "time and strain grow together: " << kind_of(found);
    const auto tool = std::find_if(found.kinds.begin(), found.kinds.end(), [](const FollowedKind& one) {
        return one.kind == Kind{Link::tool, Axis::strain};
    });
    ASSERT_NE(tool, found.kinds.end());
    EXPECT_GT(tool->posterior, 0.2);
    for (const char* wrong : {"loading-relaxation", "ageing", "contact-nonlinearity"}) {
        EXPECT_FALSE(found.verdict == Verdict::named && in_set(found, wrong)) << wrong;
    }
}

/// Fifty times the damping of the worst bearing.
TEST(Verdict, DampingFarOutsideOfItsRangeHasNoOtherName) {
    const Diagnosis found = verdict_on(sweeps(MeasurementKind::frequency_sweep, [](const Row& row) {
        return std::complex<double>(gel, 5e-3 * row.angular_frequency * per_torque());
    }));
    expect_consistent(found);
    EXPECT_TRUE(found.detected);
    EXPECT_NE(found.verdict, Verdict::named) << name_of(found.credible_set.front());
    EXPECT_EQ(found.follows.kind.axis, Axis::frequency) << kind_of(found);
}

/// One of the samples lets go of its plate little by little.
TEST(Verdict, ASampleThatDriftsAloneIsNoSuddenLoss) {
    const Diagnosis found = verdict_on(sweeps(MeasurementKind::time_sweep, [](const Row& row) {
        return std::complex<double>(gel * (row.sample == 'B' ? 1 - 6e-4 * row.time : 1.0), 0);
    }));
    expect_consistent(found);
    EXPECT_TRUE(found.detected);
    EXPECT_NE(found.verdict, Verdict::named) << name_of(found.credible_set.front());
    EXPECT_TRUE(found.follows.kind.axis == Axis::sample || found.follows.kind.axis == Axis::time) << kind_of(found);
}

/// Crystals grow and stop (Avrami, Journal of Chemical Physics 7 (1939) 1103).
TEST(Verdict, WhatNoCauseDoesIsSaidToFollowTheTime) {
    const Diagnosis found = verdict_on(sweeps(MeasurementKind::time_sweep, [](const Row& row) {
        return std::complex<double>(gel * (1.5 - 0.5 * std::exp(-std::pow(row.time / 200, 3))), 0);
    }));
    expect_consistent(found);
    EXPECT_NE(found.verdict, Verdict::named) << name_of(found.credible_set.front());
    EXPECT_EQ(found.follows.kind.axis, Axis::time) << kind_of(found);
    EXPECT_GT(found.follows.change, 0.2);
    EXPECT_NEAR(found.follows.to, 480, 1);
}

/// A cell with a slip of the decimal point makes no cause.
TEST(Verdict, OneRowTenTimesTooLargeIsNoName) {
    Experiment experiment = sweeps(MeasurementKind::frequency_sweep, [](const Row&) { return std::complex<double>(gel, 0); });
    Measurement& table = experiment.measurements.front();
    for (Column& column : table.columns) {
        if (column.name == "storage_modulus") {
            column.values.front() *= 10;
        }
    }
    const Diagnosis found = verdict_on(experiment);
    expect_consistent(found);
    EXPECT_NE(found.verdict, Verdict::named) << name_of(found.credible_set.front());
}

/// With nothing hidden no kind is followed.
TEST(Verdict, IsNoDiscrepancyWhereNothingIsHidden) {
    const Diagnosis found = verdict_on(sweeps(
        MeasurementKind::frequency_sweep, [](const Row&) { return std::complex<double>(gel, 0); }, 500));
    expect_consistent(found);
    EXPECT_EQ(found.verdict, Verdict::no_discrepancy);
    EXPECT_TRUE(found.kinds.empty());
}

/// Three sweeps of an oil of 5 Pa.s at these gaps, whose phase is off by a constant angle.
Experiment oil(double angle, const std::vector<double>& gaps) {
    Experiment experiment = sweeps(MeasurementKind::frequency_sweep, [angle](const Row& row) {
        return std::complex<double>(0, 5 * row.angular_frequency) * std::exp(std::complex<double>(0, angle));
    });
    experiment.material.kind = MaterialKind::newtonian;
    for (Measurement& table : experiment.measurements) {
        table.columns.push_back({"gap", "m", gaps});
    }
    return experiment;
}

/// In an oil G' takes what a wrong phase leaves of G'': the size that is stated is the angle, and no departure is divided by
/// the base model's G' = 0.
TEST(Verdict, StatesTheAngleOfAPhaseThatIsOff) {
    const Diagnosis found = verdict_on(oil(0.06, std::vector<double>(12, plate_gap)));
    expect_consistent(found);
    EXPECT_EQ(kind_of(found), "tool along level");
    EXPECT_NEAR(std::abs(found.follows.largest), 0.06, 0.01);
    ASSERT_FALSE(found.misfits.empty());
    for (const Misfit& misfit : found.misfits) {
        EXPECT_TRUE(std::isfinite(misfit.departure)) << misfit.axis;
        if (const auto* course = std::get_if<SmoothMisfit>(&misfit.what)) {
            EXPECT_TRUE(std::isfinite(course->before) && std::isfinite(misfit.from)) << misfit.axis;
        }
    }
}

/// A row that lost its gap is not compared at the gap of the instrument.
TEST(Verdict, RowsThatLostTheirGapTakeNoPart) {
    std::vector<double> gaps(12, plate_gap);
    const std::size_t all = verdict_on(oil(0, gaps)).observations;
    gaps[2] = unset;
    EXPECT_EQ(verdict_on(oil(0, gaps)).observations, all - 6);
    EXPECT_EQ(verdict_on(oil(0, std::vector<double>(12, unset))).observations, all) << "no row states it";
}

/// Causes that explain nothing share no probability with a departure that no cause makes.
TEST(Verdict, CausesThatExplainNothingAreNotInTheSet) {
    Experiment wavering = sweeps(MeasurementKind::time_sweep, [](const Row& row) {
        const double wave = 1 + 0.2 * std::sin(2 * std::numbers::pi * row.time / 240);
        return std::complex<double>(0, 5 * row.angular_frequency * wave);
    });
    wavering.material.kind = MaterialKind::newtonian;
    const Diagnosis found = verdict_on(wavering);
    expect_consistent(found);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"none of the catalogue"});
    EXPECT_GT(found.causes.front().posterior, 0.95);
}

}  // namespace
}  // namespace coagula::diagnose
