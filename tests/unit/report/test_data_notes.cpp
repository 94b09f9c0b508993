// SPDX-License-Identifier: GPL-3.0-or-later
// The sentences say what the checks of the data found.
#include <coagula/report/data_notes.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace coagula::report {
namespace {

using diagnose::GroupedBy;
using diagnose::LoneTable;
using diagnose::NoiseModel;
using diagnose::ReplicateGroups;

/// The sentence about one finding.
std::string sentence_on(experiment::Finding finding) {
    experiment::CheckedExperiment checked;
    checked.tables.resize(1);
    checked.tables[0].measurement.label = "sweep of B";
    checked.tables[0].measurement.sample = "B";
    checked.findings.push_back(std::move(finding));
    return notes_on(checked).front();
}

TEST(DataNotes, ALoneTableIsToldByItsFactorOrAngle) {
    EXPECT_NE(sentence_on(LoneTable{"sweep of B", "B", "complex_modulus", 1e-3})
                  .find("sweep of B, sample 'B': |G*| is 1000 times smaller than that of its replicates"),
              std::string::npos);
    EXPECT_NE(sentence_on(LoneTable{"sweep of C", "C", "phase", 0.2}).find("lies 11.5 degrees above that of its replicates"),
              std::string::npos);
    EXPECT_NE(sentence_on(LoneTable{"sweep of B", "B", "complex_modulus", 10, true, "sweep of A"})
                  .find("than that of its replicate, sweep of A"),
              std::string::npos);
}

TEST(DataNotes, GroupsAreToldByWhatTheyDifferIn) {
    const ReplicateGroups sample{GroupedBy::single_sample, {"C"}, 0.09, 0.014, "frequency-sweep"};
    EXPECT_NE(sentence_on(sample).find("sample 'C' and the others differ by 9 %"), std::string::npos);
    const ReplicateGroups day{GroupedBy::day, {"1", "2"}, 0.09, 0.014, "frequency-sweep"};
    EXPECT_NE(sentence_on(day).find("tables of different days differ by"), std::string::npos);
}

TEST(DataNotes, AClockWithoutAnOrderHidesAgeing) {
    EXPECT_NE(sentence_on(diagnose::DoubtfulClock{"sweep of B", "B", {}}).find("ageing cannot be told from noise"),
              std::string::npos);
    EXPECT_NE(sentence_on(diagnose::DoubtfulClock{"sweep of B", "B", "sweep of A"}).find("run on from those of sweep of A"),
              std::string::npos);
}

TEST(DataNotes, AStepTestIsToldByItsFrequencies) {
    const diagnose::StepConversion conversion{.measurement = 0,
                                              .kind = diagnose::MeasurementKind::stress_relaxation,
                                              .rows_used = 30,
                                              .frequencies = 7,
                                              .lowest_frequency = 0.01,
                                              .highest_frequency = 10,
                                              .largest_strain = 0.002,
                                              .errors = {},
                                              .first_time = 0.1,
                                              .last_time = 100,
                                              .label = "step of B",
                                              .sample = "B"};
    EXPECT_EQ(
        sentence_on(conversion),
        "step of B, sample 'B': 30 rows of the stress relaxation, from 0.1 s to 100 s, are compared as G* at 7 angular "
        "frequencies from 0.01 rad/s to 10 rad/s, where their transform has an error below 10 %; the sample is taken for linear "
        "up to a strain of 0.2 %");
}

TEST(DataNotes, AnOutlierIsARowOrASample) {
    EXPECT_EQ(sentence_on(diagnose::Outlier{0, 4, 10, "10 times as large as"}),
              "sweep of B, sample 'B': row 5 is left out as an outlier, |G*| is 10 times as large as in the rows beside it");
    EXPECT_EQ(sentence_on(diagnose::Outlier{0, std::nullopt, 0.4, "2.5 times as small as"}),
              "sweep of B: sample 'B' is left out as an outlier, its |G*| is 2.5 times as small as that of the others");
}

TEST(DataNotes, SayWhereNoiseComesFrom) {
    NoiseModel noise;
    EXPECT_NE(source_of(noise).find("no replicates"), std::string::npos);
    noise.rows_estimated = true;
    noise.floor_is_told = false;
    EXPECT_NE(source_of(noise).find("too similar"), std::string::npos);
}

}  // namespace
}  // namespace coagula::report
