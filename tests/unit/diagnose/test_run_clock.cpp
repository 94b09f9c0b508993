// SPDX-License-Identifier: GPL-3.0-or-later
// When runs took place: clocks, pauses and shear between them, and what is said where nobody says it.
#include <coagula/diagnose/mechanism.hpp>
#include <coagula/diagnose/run_clock.hpp>

#include "data/knows.hpp"
#include "observables/observations.hpp"

#include "example_sweeps.hpp"

#include "support/complaint.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::diagnose {
namespace {

/// A run of five rows at these times, 10 s apart from the first on.
Measurement run_at(double first, int order, double step = 10) {
    Measurement table;
    table.kind = MeasurementKind::time_sweep;
    table.label = "run " + std::to_string(order);
    table.sample = "A";
    table.run_order = order;
    table.columns = {{"time", "s", {}}, {"storage_modulus", "Pa", {}}};
    for (int row = 0; row < 5; ++row) {
        table.columns[0].values.push_back(first + step * row);
        table.columns[1].values.push_back(100 + row);
    }
    return table;
}

Experiment with(std::vector<Measurement> tables) {
    Experiment experiment;
    experiment.measurements = std::move(tables);
    return experiment;
}

/// Time and age of the first row of each table.
std::vector<std::pair<double, double>> first_rows(const Experiment& experiment) {
    std::vector<std::pair<double, double>> all;
    for (const Observation& one : observations_of(experiment)) {
        if (one.row == 0) {
            all.emplace_back(one.time, one.age);
        }
    }
    return all;
}

using Times = std::vector<std::pair<double, double>>;

/// A table whose rows stand against the order of time: the last one was measured first.
TEST(RunClock, RowsAreInTheOrderOfTheirTimes) {
    Measurement table = run_at(50, 0, -10);
    table.kind = MeasurementKind::frequency_sweep;
    table.columns.push_back({"angular_frequency", "rad/s", {1, 2, 3, 4, 5}});
    table.columns.push_back({"strain", "1", {0.5, 0.4, 0.3, 0.2, 0.1}});
    EXPECT_EQ(rows_in_time(table), (std::vector<std::size_t>{4, 3, 2, 1, 0}));
    for (const Observation& one : observations_of(with({table}))) {
        const auto from_last = static_cast<double>(4 - one.row);
        EXPECT_DOUBLE_EQ(one.place, from_last / 5) << one.row;
        EXPECT_DOUBLE_EQ(one.largest_strain, 0.1 * (from_last + 1)) << one.row;
    }
}

TEST(RunClock, RunsFollowEachOtherAfterTheirPauses) {
    Measurement second = run_at(10, 1);
    Measurement third = run_at(10, 2);
    third.pause = 600;
    EXPECT_EQ(first_rows(with({run_at(10, 0), second, third})), (Times{{10, 10}, {70, 70}, {720, 720}}));
    Measurement rested = run_at(10, 0);
    rested.pause = 300;  // after the filling
    EXPECT_EQ(first_rows(with({rested, second})), (Times{{310, 310}, {370, 370}}));
}

TEST(RunClock, AClockThatRunsOnIsNotAddedUpTwice) {
    const Experiment experiment = with({run_at(5, 0, 5), run_at(410, 1), run_at(2135, 2)});
    EXPECT_EQ(first_rows(experiment), (Times{{5, 5}, {410, 410}, {2135, 2135}}));
    ASSERT_EQ(doubtful_clocks(experiment).size(), 2u);
    EXPECT_EQ(doubtful_clocks(experiment)[1].runs_on_from, experiment.measurements[1].label);
    // A clock of its own begins with about a step, whatever the run before.
    const Experiment own = with({run_at(5, 0, 5), run_at(60, 1, 60)});
    EXPECT_EQ(first_rows(own), (Times{{5, 5}, {95, 95}}));
    EXPECT_TRUE(doubtful_clocks(own).empty());
    Measurement stated = run_at(410, 1);
    stated.shared_clock = false;
    EXPECT_EQ(first_rows(with({run_at(5, 0, 5), stated})), (Times{{5, 5}, {445, 445}}));
}

TEST(RunClock, ASharedClockNeedsNoOrder) {
    Measurement first = run_at(10, 0);
    Measurement second = run_at(30, 0, 60);
    first.shared_clock = second.shared_clock = true;
    EXPECT_EQ(first_rows(with({second, first})), (Times{{30, 30}, {10, 10}}));
    EXPECT_TRUE(doubtful_clocks(with({second, first})).empty());
}

TEST(RunClock, StartsAreThoseOfOneClock) {
    Measurement first = run_at(0, 0);
    Measurement second = run_at(0, 0);
    first.start = 1.6e9;
    second.start = 1.6e9 + 3600;
    EXPECT_EQ(first_rows(with({second, first})), (Times{{3600, 3600}, {0, 0}}));
    Measurement between = run_at(10, 1);  // without a start, after the first
    second.run_order = 2;
    EXPECT_EQ(first_rows(with({first, between, second})), (Times{{0, 0}, {60, 60}, {3600, 3600}}));
}

TEST(RunClock, ShearBeforeARunBeginsItsAge) {
    Measurement second = run_at(10, 1);
    second.preshear = 120;
    Measurement third = run_at(10, 2);
    EXPECT_EQ(first_rows(with({run_at(10, 0), second, third})), (Times{{10, 10}, {190, 10}, {250, 70}}));
    Measurement on_one_clock = run_at(500, 1);
    on_one_clock.preshear = 0;
    EXPECT_EQ(first_rows(with({run_at(10, 0), on_one_clock})), (Times{{10, 10}, {500, 10}}));
    Experiment always = with({run_at(10, 0), run_at(10, 1)});
    always.sample.sheared_before = true;
    EXPECT_EQ(first_rows(always), (Times{{10, 10}, {70, 10}}));
    EXPECT_TRUE(find_mechanism("ageing-after-shear")->applies(knowledge_of(with({run_at(10, 0), second}))));
}

TEST(RunClock, RunsWithoutAnOrderHaveNoAge) {
    const Experiment experiment = with({run_at(10, 0), run_at(10, 0)});
    for (const auto& [time, age] : first_rows(experiment)) {
        EXPECT_TRUE(std::isnan(time) && std::isnan(age));
    }
    ASSERT_EQ(doubtful_clocks(experiment).size(), 2u);
    EXPECT_TRUE(doubtful_clocks(experiment)[0].runs_on_from.empty());
    EXPECT_FALSE(find_mechanism("ageing")->applies(knowledge_of(experiment)));
    EXPECT_TRUE(find_mechanism("ageing")->applies(knowledge_of(with({run_at(10, 0), run_at(10, 1)}))));
    Measurement waveforms = run_at(10, 0);
    waveforms.kind = MeasurementKind::harmonics;  // were recorded during the run
    EXPECT_TRUE(doubtful_clocks(with({run_at(10, 0), waveforms})).empty());
    Measurement oil = run_at(10, 0);
    oil.fluid_viscosity = 1;
    EXPECT_TRUE(doubtful_clocks(with({run_at(10, 0), oil})).empty());
}

TEST(RunClock, ARowWithoutATimeHasThatOfItsNeighbour) {
    Measurement table = run_at(400, 0);
    table.columns[0].values[0] = table.columns[0].values[3] = unset;
    EXPECT_EQ(time_in(table, 0), 410);
    EXPECT_EQ(time_in(table, 3), 420);
    table.columns.erase(table.columns.begin());
    EXPECT_EQ(time_in(table, 3), 30);
}

TEST(RunClock, ContradictionsAreRefused) {
    Measurement late = run_at(0, 0);
    Measurement early = run_at(0, 1);
    late.start = 1000;
    early.start = 500;
    EXPECT_EQ(first_rows(with({late, early}))[0].first, 500);  // starts go before the order
    Measurement overlapping = run_at(0, 0, 100);
    overlapping.start = 500;
    late.start = 600;
    EXPECT_NE(testing::complaint([&] { run_times(with({overlapping, late})); }).find("begins 300 s before"), std::string::npos);
    late.start = 1.6e9;
    EXPECT_NE(testing::complaint([&] { run_times(with({overlapping, late})); }).find("as dates"), std::string::npos);
    Measurement on_one_clock = run_at(410, 1);
    on_one_clock.pause = 60;
    EXPECT_NE(testing::complaint([&] { run_times(with({run_at(5, 0), on_one_clock})); }).find("'pause'"), std::string::npos);
    on_one_clock.pause = unset;
    Measurement started = run_at(5, 0);
    started.start = 0;
    on_one_clock.start = 400;  // both say the same
    EXPECT_EQ(first_rows(with({started, on_one_clock})), (Times{{5, 5}, {410, 410}}));
    on_one_clock.start = 1400;
    EXPECT_NE(testing::complaint([&] { run_times(with({started, on_one_clock})); }).find("leave 'start' out"), std::string::npos);
}

}  // namespace
}  // namespace coagula::diagnose
