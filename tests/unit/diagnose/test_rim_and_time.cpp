// SPDX-License-Identifier: GPL-3.0-or-later
// What changes with the time since the filling, and what happens at the rim: each against its law, by another way.
#include "chain/forward.hpp"
#include "data/knows.hpp"
#include "hidden_effects.hpp"

#include <coagula/diagnose/mechanism.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

using std::numbers::pi;
constexpr double radius = 20e-3;
constexpr double gap = 1e-3;

/// Of a row between plates [m], under a cone where its angle is given.
Observation row_at(double time, double cone_angle = unset) {
    Observation row;
    row.time = row.age = time;
    row.plate_radius = radius;
    row.gap = std::isnan(cone_angle) ? gap : unset;
    row.cone_angle = cone_angle;
    return row;
}

const Mechanism& cause(const std::string& name) {
    const Mechanism* found = find_mechanism(name);
    if (found == nullptr) {
        throw std::runtime_error(name + " is missing");
    }
    return *found;
}

Complex shown(const std::string& name, Complex modulus, const Observation& row, std::vector<double> values) {
    return std::get<ChangesGeometry>(cause(name).effect).apparent(modulus, row, values);
}

/// Factor on the modulus of the material, which asks for no structures.
Complex factor(const std::string& name, const Observation& row, std::vector<double> values) {
    static const Experiment none;
    static const Settings settings;
    static const StrainHistory history(none);
    return std::get<ScalesMaterial>(cause(name).effect).factor(row, values, {none, simulator(), settings, history, false});
}

/// Torque of rings of a material and of a skin around them, per angle, over that of a modulus of 1 Pa.
Complex by_rings(Complex modulus, double skin, double filled, double cone_angle) {
    constexpr double rings = 20000;
    const bool cone = std::isfinite(cone_angle);
    const auto strain = [&](double at) { return cone ? 1 / cone_angle : at / gap; };
    Complex torque = 2 * pi * filled * skin * strain(filled) * filled;
    double of_one = 0;
    for (int k = 0; k < static_cast<int>(rings); ++k) {
        const double ring = k + 0.5;
        const double at = filled * ring / rings;
        torque += modulus * strain(at) * 2.0 * pi * at * at * filled / rings;
        const double stated = radius * ring / rings;
        of_one += strain(stated) * 2 * pi * stated * stated * radius / rings;
    }
    return torque / of_one;
}

TEST(DryingRim, AddsTheTorqueOfARingThatIsStrainedAsTheRimIs) {
    constexpr double growth = 2e-3;  // N/(m s)
    for (const double angle : {unset, 0.03}) {
        for (const Complex modulus : {Complex(500, 30), Complex(0, 4)}) {
            const Complex seen = shown("drying-rim", modulus, row_at(600, angle), {growth});
            EXPECT_NEAR(std::abs(seen - by_rings(modulus, growth * 600, radius, angle)), 0, 1e-6 * std::abs(seen));
        }
    }
    Observation trapped = row_at(600);
    trapped.solvent_trap = true;
    EXPECT_EQ(shown("drying-rim", Complex(500, 30), trapped, {growth}), Complex(500, 30));
    EXPECT_EQ(factor("evaporation", trapped, {1e-5, 4.5}), Complex(1));
    Observation oil = row_at(600);
    oil.fluid_viscosity = 1;
    EXPECT_EQ(shown("drying-rim", Complex(0, 4), oil, {growth}), Complex(0, 4));
}

TEST(RadiusError, IsTheTorqueOfWhatFillsAnotherRadius) {
    for (const double angle : {unset, 0.03}) {
        for (const double error : {-8e-4, 5e-4}) {
            const Complex seen = shown("radius-error", Complex(500, 30), row_at(0, angle), {error});
            EXPECT_NEAR(std::abs(seen / by_rings(Complex(500, 30), 0, radius + error, angle) - 1.0), 0, 1e-7);
        }
    }
}

/// One sample at a gap: strains up in one run, down in the next.
std::vector<Measurement> up_and_down(double at_gap, const std::string& sample) {
    const std::vector<double> up{0.1, 0.3, 1, 3};
    std::vector<Measurement> runs;
    for (int order = 0; order < 2; ++order) {
        Measurement table;
        table.kind = MeasurementKind::amplitude_sweep;
        table.sample = sample;
        table.run_order = order;
        table.columns = {{"strain", "1", order == 0 ? up : std::vector<double>(up.rbegin(), up.rend())},
                         {"gap", "m", std::vector<double>(4, at_gap)},
                         {"storage_modulus", "Pa", std::vector<double>(4, 1.0)}};
        runs.push_back(table);
    }
    return runs;
}

/// A flat loss at one strain is that of contacts, of the phase or of anything else.
TEST(ReversibleSoftening, IsNoCauseAtOneStrain) {
    Experiment experiment;
    experiment.measurements = up_and_down(1e-3, "a");
    EXPECT_TRUE(can_act(cause("reversible-softening"), experiment));
    for (Measurement& table : experiment.measurements) {
        table.columns[0].values.assign(4, 1e-3);
    }
    EXPECT_FALSE(can_act(cause("reversible-softening"), experiment));
}

TEST(EdgeFracture, DoesNotHealAndComesEarlierAtAWiderGap) {
    Experiment experiment;
    experiment.measurements = up_and_down(1e-3, "narrow");
    for (Measurement& table : up_and_down(4e-3, "wide")) {
        experiment.measurements.push_back(std::move(table));
    }
    const std::vector<Observation> rows = observations_of(experiment);
    const auto share = [&](std::size_t row) { return shown("edge-fracture", 1, rows.at(row), {0.5, 2}).real(); };
    const std::array up{1.0, 1.0, 0.25, std::pow(0.5 / 3, 2)};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(share(k), up[k], 1e-12);
        EXPECT_NEAR(share(4 + k), up[3], 1e-12);  // nothing comes back
        EXPECT_NEAR(share(8 + k), std::min(1.0, std::pow(0.25 / std::array{0.1, 0.3, 1.0, 3.0}[k], 2)), 1e-12);
    }
    EXPECT_TRUE(cause("edge-fracture").applies(knowledge_of(experiment)));
    for (Measurement& table : experiment.measurements) {
        table.columns[0].values = {0.001, 0.002, 0.01, 0.03};
    }
    EXPECT_FALSE(cause("edge-fracture").applies(knowledge_of(experiment)));
}

TEST(Evaporation, TakesTwiceAsMuchFromHalfTheRadiusWhateverTheGap) {
    Observation small = row_at(1000);
    small.plate_radius = radius / 2;
    Observation wide = row_at(2000);
    wide.gap = 3 * gap;
    const double lost = 1e-5 * 2000 * 25e-3 / radius;  // of the volume
    EXPECT_NEAR(std::abs(factor("evaporation", small, {1e-5, 4.5})), std::pow(1 - lost, -4.5), 1e-12);
    EXPECT_NEAR(std::abs(factor("evaporation", wide, {1e-5, 4.5})), std::pow(1 - lost, -4.5), 1e-12);
    EXPECT_TRUE(std::isfinite(std::abs(factor("evaporation", row_at(1e9), {1e-4, 6}))));
}

TEST(AgeingLaws, BeginAtOneAndKeepTheirLaws) {
    for (const char* name : {"ageing-power", "ageing-saturating"}) {
        EXPECT_EQ(factor(name, row_at(0), {2, 100}), Complex(1)) << name;
        EXPECT_EQ(factor(name, row_at(unset), {2, 100}), Complex(1)) << name;
    }
    const auto grown = [](const char* name, double age, double strength) {
        return factor(name, row_at(age), {strength, 100}).real();
    };
    // Far on, each decade multiplies by the same; an end that is reached is three times the start.
    EXPECT_NEAR(grown("ageing-power", 1e9, 2.9) / grown("ageing-power", 1e8, 2.9), std::pow(10, 2.9), 1e-2);
    EXPECT_NEAR(grown("ageing-saturating", 1e5, 2), 3, 1e-12);
    // Of first order: what is left halves in each time of log 2.
    EXPECT_NEAR((3 - grown("ageing-saturating", 100 * std::log(2), 2)) / 2, 0.5, 1e-12);
    EXPECT_NEAR(factor("temperature-drift", row_at(300 * std::log(2)), {-0.2, 300}).real(), std::exp(-0.1), 1e-12);
}

/// Two runs on one sample, then another sample: only what comes later on that sample is lower.
TEST(SuddenLoss, StaysWithItsSampleAndLeavesTheOthers) {
    Experiment experiment;
    experiment.measurements = up_and_down(1e-3, "a");
    for (Measurement& table : up_and_down(1e-3, "b")) {
        experiment.measurements.push_back(std::move(table));
    }
    std::swap(experiment.measurements[0], experiment.measurements[1]);  // the clock counts, not the order of the tables
    const std::vector<Observation> rows = observations_of(experiment);
    const auto share = [&](std::size_t row) { return shown("sudden-loss", 1, rows.at(row), {2.5 / 16, 0.6}).real(); };
    for (std::size_t k = 0; k < 16; ++k) {
        const bool later_run = k < 4;
        const bool behind = k == 7;
        EXPECT_EQ(share(k), later_run || behind ? 0.6 : 1.0) << k;
    }
}

/// One or two rows that differ, at the beginning or at the end, are outliers.
TEST(SuddenLoss, HasThreeRowsBeforeAndBehindIt) {
    Experiment experiment;
    experiment.measurements = up_and_down(1e-3, "a");
    const std::vector<Observation> rows = observations_of(experiment);
    const auto changed = [&](double place) {
        return std::count_if(rows.begin(), rows.end(), [&](const Observation& row) {
            return shown("sudden-loss", 1, row, {place, 0.6}).real() < 1;
        });
    };
    const std::vector<std::ptrdiff_t> behind{0, 0, 5, 4, 3, 0, 0, 0};
    for (std::size_t k = 0; k < behind.size(); ++k) {
        EXPECT_EQ(changed((static_cast<double>(k) + 0.5) / 8), behind[k]) << k;
    }
}

/// Of a material without a model nobody knows whether it yielded; another table on it tells, and networks have a law for it.
TEST(SuddenLoss, OfASmoothMaterialNeedsMoreThanAGrowingStrain) {
    Measurement sweep;
    sweep.kind = MeasurementKind::amplitude_sweep;
    sweep.sample = "gel";
    sweep.columns = {{"strain", "1", {1e-3, 2e-3, 4e-3, 8e-3, 0.016, 0.03, 0.06, 0.12}},
                     {"storage_modulus", "Pa", {100, 100, 100, 100, 100, 10, 10, 10}}};
    Experiment gel;
    gel.measurements = {sweep};
    EXPECT_TRUE(can_act(cause("sudden-loss"), gel));
    gel.material.kind = MaterialKind::smooth;
    EXPECT_FALSE(can_act(cause("sudden-loss"), gel));
    Measurement after = sweep;
    after.kind = MeasurementKind::frequency_sweep;
    after.columns[0] = {"angular_frequency", "rad/s", {1, 2, 3, 4, 5, 6, 7, 8}};
    gel.measurements.push_back(after);
    EXPECT_TRUE(can_act(cause("sudden-loss"), gel));
    gel.measurements = {sweep};
    gel.measurements[0].columns[0].values = {1e-3, 2e-3, 4e-3, 8e-3, 4e-3, 2e-3, 1e-3, 5e-4};  // down again
    EXPECT_TRUE(can_act(cause("sudden-loss"), gel));
}

/// Filled cold, an oil shows less and less viscosity, which moduli and flow curves tell alike.
TEST(TemperatureDrift, ActsOnAnOilAndOnNoMaterialThatNobodyHasAModelOf) {
    Experiment oil;
    oil.material.kind = MaterialKind::newtonian;
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.sample = "oil";
    table.columns = {{"time", "s", {10, 1000}},
                     {"angular_frequency", "rad/s", {2, 2}},
                     {"storage_modulus", "Pa", {0, 0}},
                     {"loss_modulus", "Pa", {2, 2}}};
    oil.measurements = {table};
    const std::vector<Observation> rows = observations_of(oil);
    const Model drifting({&cause("temperature-drift")}, std::array{0.2, 200.0});
    const Forward forward(oil, rows, simulator());
    const Eigen::ArrayXd ratio = forward.predict(drifting).array() / forward.predict(Model{}).array();
    EXPECT_NEAR(ratio[2], std::exp(0.2 * std::exp(-0.05)), 1e-12);
    EXPECT_NEAR(ratio[3], std::exp(0.2 * std::exp(-5.0)), 1e-12);
    EXPECT_TRUE(can_act(cause("temperature-drift"), oil));
    EXPECT_FALSE(can_act(cause("ageing-saturating"), oil));
    oil.material.kind = MaterialKind::smooth;
    EXPECT_FALSE(can_act(cause("temperature-drift"), oil));
}

}  // namespace
}  // namespace coagula::diagnose
