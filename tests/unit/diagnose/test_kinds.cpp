// SPDX-License-Identifier: GPL-3.0-or-later
// These tests hold what an experiment tells of a departure: which axis it follows, and whether a cause can be told from its
// look-alikes.
#include "hidden_effects.hpp"
#include "infer/kinds.hpp"
#include "noise/data_set.hpp"

#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

Measurement run_between(const std::string& sample, double gap, double plate_radius = 0.0125) {
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.label = table.sample = sample;
    const auto all = [](double value) { return std::vector<double>(6, value); };
    table.columns = {{"time", "s", {10, 30, 100, 300, 1000, 3000}},
                     {"storage_modulus", "Pa", {1000, 1010, 1030, 1060, 1090, 1100}},
                     {"loss_modulus", "Pa", all(100)},
                     {"angular_frequency", "rad/s", all(6)},
                     {"gap", "m", all(gap)},
                     {"plate_radius", "m", all(plate_radius)}};
    return table;
}

Measurement oil_between(double gap = 1e-3) {
    Measurement table = run_between("oil", gap);
    table.fluid_viscosity = 5;
    return table;
}

Experiment experiment_with(std::vector<Measurement> tables, MaterialKind material = MaterialKind::smooth) {
    Experiment experiment;
    experiment.material.kind = material;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    experiment.measurements = std::move(tables);
    return experiment;
}

bool separated(const char* cause, const Experiment& experiment) {
    return is_separated(*find_mechanism(cause), experiment);
}

/// Water that flows back, a sample that settles: the time they take goes with the gap, which an oil does not show.
TEST(Separation, WhatTheGapRulesNeedsGaps) {
    for (const char* cause : {"poroelastic-backflow", "sedimentation"}) {
        EXPECT_FALSE(separated(cause, experiment_with({run_between("A", 1e-3), oil_between()})))
            << cause << ": setting does the same";
        EXPECT_TRUE(separated(cause, experiment_with({run_between("A", 1e-3), run_between("B", 5e-4)}))) << cause;
    }
}

TEST(Separation, WhatTheRimDoesNeedsPlatesOrATrap) {
    Measurement trapped = run_between("B", 1e-3);
    trapped.solvent_trap = true;
    for (const char* cause : {"evaporation", "drying-rim"}) {
        EXPECT_FALSE(separated(cause, experiment_with({run_between("A", 1e-3), oil_between()}))) << cause;
        EXPECT_FALSE(separated(cause, experiment_with({run_between("A", 1e-3), run_between("B", 5e-4)})))
            << cause << ": as at every gap";
        EXPECT_TRUE(separated(cause, experiment_with({run_between("A", 1e-3), run_between("B", 1e-3, 0.025)}))) << cause;
        EXPECT_TRUE(separated(cause, experiment_with({run_between("A", 1e-3), trapped}))) << cause;
    }
}

/// A slip of one length, or samples that differ, look like a wrong gap or radius; an oil neither slips nor differs.
TEST(Separation, AWrongGapOrRadiusNeedsAnOil) {
    const Experiment gaps = experiment_with({run_between("A", 1e-3), run_between("B", 5e-4)});
    const Experiment plates = experiment_with({run_between("A", 1e-3), run_between("B", 1e-3, 0.025)});
    EXPECT_FALSE(separated("gap-error", gaps));
    EXPECT_FALSE(separated("radius-error", plates));
    EXPECT_TRUE(separated("gap-error", experiment_with({run_between("A", 1e-3), oil_between(5e-4)})));
    EXPECT_TRUE(separated("radius-error", experiment_with({run_between("A", 1e-3, 0.025), oil_between()})));
    EXPECT_TRUE(separated("gap-error", experiment_with(gaps.measurements, MaterialKind::newtonian))) << "the sample is an oil";
}

TEST(Separation, SlipNeedsGapsOrRoughPlates) {
    EXPECT_FALSE(separated("wall-slip", experiment_with({run_between("A", 1e-3), run_between("B", 1e-3)})));
    EXPECT_TRUE(separated("wall-slip", experiment_with({run_between("A", 1e-3), run_between("B", 5e-4)})));
    Measurement rough = run_between("B", 1e-3);
    rough.rough_plates = true;
    EXPECT_TRUE(separated("wall-slip", experiment_with({run_between("A", 1e-3), rough})));
}

/// A tool that gives way to the force changes the gap.
TEST(Separation, ALoadNeedsGaps) {
    std::vector<Measurement> pressed{run_between("A", 1e-3), run_between("B", 1e-3)};
    for (Measurement& table : pressed) {
        table.columns.push_back({"normal_force", "N", {1, 0.8, 0.6, 0.5, 0.4, 0.3}});
    }
    EXPECT_FALSE(separated("normal-load", experiment_with(pressed)));
    pressed[1].columns[4].values.assign(6, 5e-4);
    EXPECT_TRUE(separated("normal-load", experiment_with(pressed)));
}

/// Kinds of an experiment of which one cause explains all.
std::vector<FollowedKind> kinds_by(const char* cause, const Experiment& experiment, bool fits) {
    const DataSet data = data_set_of(experiment, {.sample = 0.1});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    Comparison comparison;
    comparison.all.resize(2);
    comparison.all[0].fit.log_evidence = -1e3;
    comparison.all[1].fit.hypothesis = {find_mechanism(cause)};
    comparison.all[1].fit.log_evidence = -900;
    comparison.forms = {{{Link::geometry, Axis::gap}, 90, {}}, {{Link::history, Axis::time}, 50, {}}};
    return kinds_of(comparison, inference, fits);
}

/// A strain amplitude is no axis of a flow curve.
TEST(Kinds, AnOffsetOfTheTorqueFollowsTheRateOfAFlowCurve) {
    Measurement curve;
    curve.kind = MeasurementKind::flow_curve;
    curve.label = curve.sample = "A";
    curve.columns = {{"shear_rate", "1/s", {0.1, 1, 10, 100, 1000}}, {"viscosity", "Pa.s", {3, 1, 1, 1, 1}}};
    const Experiment experiment = experiment_with({curve}, MaterialKind::newtonian);
    EXPECT_TRUE(separated("torque-offset", experiment));
    const Kind kind = kinds_by("torque-offset", experiment, true).front().kind;
    EXPECT_EQ(kind.link, Link::tool);
    EXPECT_EQ(kind.axis, Axis::shear_rate);
}

/// Gaps in order of size, one after the other: a law of time that comes near says nothing of the time, unless it fits.
TEST(Kinds, AxesThatRunTogetherAreNotTold) {
    Measurement series;
    series.kind = MeasurementKind::gap_series;
    series.label = series.sample = "A";
    series.columns = {{"gap", "m", {2e-3, 1e-3, 7e-4, 5e-4, 3e-4, 2e-4}}, {"storage_modulus", "Pa", {100, 101, 99, 95, 90, 85}}};
    const std::vector<FollowedKind> shared = kinds_by("loading-relaxation", experiment_with({series}), false);
    EXPECT_EQ(shared[0].kind.axis, Axis::time);
    EXPECT_EQ(shared[1].kind.axis, Axis::gap);
    EXPECT_NEAR(shared[0].posterior, 0.5, 1e-9);
    EXPECT_NEAR(shared[1].posterior, 0.5, 1e-9);
    EXPECT_GT(kinds_by("loading-relaxation", experiment_with({series}), true).front().posterior, 0.99);
    for (Column& column : series.columns) {
        std::swap(column.values[0], column.values[4]);
        std::swap(column.values[2], column.values[5]);
    }
    EXPECT_GT(kinds_by("loading-relaxation", experiment_with({series}), false).front().posterior, 0.99) << "in no order";
}

/// Two links along one axis are together more probable than a third along another.
TEST(Kinds, TheAxisIsThatOfAllItsLinks) {
    const Experiment experiment = experiment_with({run_between("A", 1e-3)});
    const DataSet data = data_set_of(experiment, {.sample = 0.1});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const auto kind = [](Link link, Axis axis, double posterior) {
        FollowedKind one{.kind = {link, axis}};
        one.posterior = posterior;
        return one;
    };
    const auto followed = [&](const std::vector<FollowedKind>& kinds) { return follows_of(kinds, Comparison(), inference).kind; };
    const FollowedKind time = kind(Link::history, Axis::time, 0.4);
    const FollowedKind rate = kind(Link::material, Axis::shear_rate, 0.35);
    EXPECT_EQ(followed({time, rate, kind(Link::tool, Axis::shear_rate, 0.25)}), rate.kind);
    EXPECT_EQ(followed({time, rate, kind(Link::geometry, Axis::age, 0.25)}), time.kind) << "an age is a time";
}

/// The time since the filling and that since a shear are no two axes.
TEST(Kinds, AgeAndTimeAreOneAxis) {
    const std::vector<FollowedKind> kinds = kinds_by("ageing-after-shear", experiment_with({run_between("A", 1e-3)}), false);
    EXPECT_EQ(kinds.front().kind, (Kind{Link::history, Axis::age}));
    EXPECT_GT(kinds.front().posterior, 0.99);
}

/// Kinds where one of three samples departs, and no cause does.
std::vector<FollowedKind> kinds_where_one_departs(const Experiment& experiment) {
    const DataSet data = data_set_of(experiment, {.sample = 0.1});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    Comparison comparison;
    comparison.all.resize(1);
    comparison.all[0].fit = inference.fit({});
    Eigen::VectorXd departure = Eigen::VectorXd::Zero(data.size());
    for (Index row = 0; row < data.size(); ++row) {
        departure[row] = data.sample_names[static_cast<std::size_t>(data.sample[static_cast<std::size_t>(row)])] == "C" ? 200 : 0;
    }
    comparison.forms = {{{Link::errors, Axis::sample}, 90, departure},
                        {{Link::history, Axis::time}, 50, departure},
                        {{Link::material, Axis::strain}, 40, departure}};
    return kinds_of(comparison, inference, false);
}

/// A sample that alone was measured at another gap, or with a trap, departs by what it is or by how it was set.
TEST(Kinds, ASampleIsNotToldFromItsSetting) {
    std::vector<Measurement> tables{run_between("A", 1e-3), run_between("B", 1e-3), run_between("C", 1e-3)};
    EXPECT_GT(kinds_where_one_departs(experiment_with(tables)).front().posterior, 0.99);
    const auto shared = [&](const std::vector<Measurement>& set) {
        const std::vector<FollowedKind> kinds = kinds_where_one_departs(experiment_with(set));
        EXPECT_EQ(kinds[0].kind.axis, Axis::sample);
        EXPECT_EQ(kinds[1].kind.axis, Axis::time);
        EXPECT_NEAR(kinds[0].posterior, 0.5, 1e-9);
        EXPECT_NEAR(kinds[1].posterior, 0.5, 1e-9);
    };
    std::vector<Measurement> trapped = tables;
    trapped[2].solvent_trap = true;
    shared(trapped);
    std::vector<Measurement> nearer = tables;
    nearer[2] = run_between("C", 5e-4);
    shared(nearer);
    nearer[1] = run_between("B", 5.1e-4);
    EXPECT_GT(kinds_where_one_departs(experiment_with(nearer)).front().posterior, 0.99) << "B was measured as C was";
}

/// At one gap slip acts by the modulus, which the frequency changes; an error of the gap is one factor.
TEST(Kinds, SlipAtOneGapFollowsTheFrequency) {
    Measurement sweep;
    sweep.kind = MeasurementKind::frequency_sweep;
    sweep.label = sweep.sample = "A";
    sweep.columns = {{"angular_frequency", "rad/s", {1, 2, 4, 8, 16}},
                     {"storage_modulus", "Pa", {1, 1, 2, 3, 4}},
                     {"loss_modulus", "Pa", {5, 10, 20, 40, 80}},
                     {"gap", "m", std::vector<double>(5, 1e-3)}};
    EXPECT_EQ(kinds_by("wall-slip", experiment_with({sweep}), true).front().kind, (Kind{Link::geometry, Axis::frequency}));
    EXPECT_EQ(kinds_by("gap-error", experiment_with({sweep}), true).front().kind, (Kind{Link::geometry, Axis::level}));
}

}  // namespace
}  // namespace coagula::diagnose
