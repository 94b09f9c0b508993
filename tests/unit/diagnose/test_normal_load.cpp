// SPDX-License-Identifier: GPL-3.0-or-later
// What the plates' pressure does to a sample: the law against a network of Hertz contacts that is pressed, and whole diagnoses.
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "observables/observations.hpp"

#include <coagula/diagnose/mechanism.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

constexpr double plate = 12.5e-3;
constexpr double area = std::numbers::pi * plate * plate;
constexpr double contact_pressure = 2e4;

const Mechanism& load_cause(const std::string& name) {
    return *find_mechanism(name);
}

Complex pressed_by(Complex modulus, double force, double of_plate = plate, double fluid = unset) {
    Observation row;
    row.plate_radius = of_plate;
    row.normal_force = force;
    row.fluid_viscosity = fluid;
    return std::get<ChangesGeometry>(load_cause("normal-load").effect).apparent(modulus, row, std::array{contact_pressure});
}

/// tests/benchmark/diagnosis_campaign/pressed.py: structures of Hertz contacts with adhesion, in equilibrium between plates, at
/// pressures over that of their adhesion: mean of four of 400 particles at a volume fraction of 0.4, one of coordination 5.4, one
/// of volume fraction 0.5 and one of 1000 particles.
TEST(NormalLoad, IsWhatNetworksOfHertzContactsShow) {
    constexpr std::array<std::array<double, 5>, 7> networks{{{-0.1, 0.958, 0.970, 0.971, 0.961},
                                                             {-0.05, 0.983, 0.986, 0.986, 0.981},
                                                             {0.05, 1.015, 1.013, 1.013, 1.016},
                                                             {0.1, 1.028, 1.026, 1.024, 1.031},
                                                             {0.2, 1.052, 1.048, 1.046, 1.056},
                                                             {0.3, 1.070, 1.068, 1.064, 1.076},
                                                             {0.4, 1.085, 1.087, 1.080, 1.090}}};
    for (const auto& row : networks) {
        const double law = pressed_by(500, row[0] * contact_pressure * area).real() / 500;
        for (std::size_t k = 1; k < row.size(); ++k) {
            EXPECT_NEAR(law, row[k], 0.008 + 0.03 * std::abs(std::min(row[0], 0.0))) << row[0];
        }
    }
}

TEST(NormalLoad, GoesByTheForceOverTheAreaOfThePlates) {
    const Complex modulus(500, 30);
    EXPECT_EQ(pressed_by(modulus, 0), modulus);
    EXPECT_EQ(pressed_by(modulus, unset), modulus);
    EXPECT_NEAR(std::abs(pressed_by(modulus, 1) - pressed_by(modulus, 4, 2 * plate)), 0, 1e-9);
    EXPECT_GT(std::abs(pressed_by(modulus, -1e6)), 0.8 * std::abs(modulus));  // what is torn off counts no further
    EXPECT_EQ(pressed_by(Complex(0, 4), 1, plate, 1.0), Complex(0, 4));
}

enum class Load { stiffens, is_recorded, is_hidden };

/// Two runs on each of two samples, whose load relaxes in ways of their own; or something that falls in another time.
Experiment pressed_gel(Load load, std::uint64_t seed) {
    Experiment made;
    made.sample.particle_radius = 0.25e-6;
    made.instrument = {.geometry = Geometry::plate_plate, .plate_radius = plate, .gap = 1e-3};
    for (const auto& [force, relaxation] : {std::pair{4.0, 900.0}, std::pair{2.0, 250.0}}) {
        Measurement table;
        table.kind = MeasurementKind::time_sweep;
        table.label = table.sample = std::to_string(made.measurements.size());
        table.columns = {{"time", "s", logarithmic_steps(10, 3600, 25)}, {"normal_force", "N", {}}};
        std::vector<Complex> moduli;
        for (const double time : table.columns[0].values) {
            const double newton = force * std::exp(-std::sqrt(time / relaxation));
            const double pressure = newton / area / contact_pressure;
            const double falling = 0.1 * std::exp(-time / 300);
            table.columns[1].values.push_back(newton);
            moduli.emplace_back(500 * (load == Load::stiffens ? 1 + pressure / 3 / (1 + 1.5 * pressure) : 1 + falling));
        }
        if (load == Load::is_hidden) {
            table.columns.pop_back();
        }
        add_moduli(table, moduli, 0.005, seed + made.measurements.size());
        made.measurements.push_back(table);
    }
    return made;
}

TEST(NormalLoad, IsFoundWithItsPressureWhereModuliFollowTheForce) {
    const Diagnosis found = diagnosis_with(199, pressed_gel(Load::stiffens, 3));
    EXPECT_EQ(found.verdict, Verdict::tied) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), (std::vector<std::string>{"normal-load", "none of the catalogue"}))
        << "its three samples foretell each other with an interval that holds none";
    EXPECT_LT(found.causes.front().parameters[1].low, contact_pressure);
    EXPECT_GT(found.causes.front().parameters[1].high, contact_pressure);
}

TEST(NormalLoad, IsNotWhatFallsInATimeOfItsOwn) {
    const Diagnosis found = diagnosis_with(199, pressed_gel(Load::is_recorded, 3));
    ASSERT_TRUE(found.detected);
    EXPECT_FALSE(in_set(found, "normal-load"));
    EXPECT_FALSE(in_set(found, "loading-relaxation"));
    EXPECT_TRUE(in_set(found, "temperature-drift"));
}

/// Nobody can tell without the normal force.
TEST(LoadingRelaxation, IsTiedWithTheTemperatureWhereTheForceWasNotRecorded) {
    const Diagnosis found = diagnosis_with(199, pressed_gel(Load::is_hidden, 3));
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "loading-relaxation"));
    EXPECT_TRUE(in_set(found, "temperature-drift"));
}

TEST(NormalLoad, NeedsTheForceInEveryRowAndAPlate) {
    const Experiment experiment = pressed_gel(Load::stiffens, 3);
    EXPECT_TRUE(can_act(load_cause("normal-load"), experiment));
    EXPECT_FALSE(can_act(load_cause("loading-relaxation"), experiment));
    Experiment other = experiment;
    other.material.kind = MaterialKind::smooth;
    EXPECT_TRUE(can_act(load_cause("normal-load"), other));
    other.material.kind = MaterialKind::newtonian;
    EXPECT_FALSE(can_act(load_cause("normal-load"), other));
    other = experiment;
    other.measurements.back().columns[1].values.back() = unset;
    EXPECT_FALSE(can_act(load_cause("normal-load"), other));
    EXPECT_TRUE(can_act(load_cause("loading-relaxation"), other));
    other.sample.sheared_before = true;
    EXPECT_FALSE(can_act(load_cause("loading-relaxation"), other));
    other = experiment;
    other.instrument.plate_radius = unset;
    EXPECT_FALSE(can_act(load_cause("normal-load"), other));
    other = experiment;
    for (Measurement& table : other.measurements) {
        table.columns[1].values.assign(table.rows(), 0.3);
    }
    EXPECT_FALSE(can_act(load_cause("normal-load"), other));
}

}  // namespace
}  // namespace coagula::diagnose
