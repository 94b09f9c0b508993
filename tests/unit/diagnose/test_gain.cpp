#include "infer/gain.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coagula::diagnose {
namespace {

/// A gap series of eight rows; only those from `first` on are readable.
std::vector<std::vector<bool>> folds_of_eight(std::size_t first) {
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.sample = "one";
    table.columns = {{"gap", "m", std::vector<double>(8, 1e-3)}};
    Experiment experiment;
    experiment.measurements = {table};
    std::vector<Observation> observations;
    for (std::size_t row = first; row < 8; ++row) {
        observations.push_back({0, row});
    }
    return choose_folds(experiment, observations, 0.3);
}

TEST(Gain, HoldsOutTheEndOfTheOnlyTable) {
    EXPECT_EQ(folds_of_eight(2), (std::vector<std::vector<bool>>{{false, false, false, false, true, true}}));
}

TEST(Gain, HoldsOutNothingWhereFewerThanFourNumbersRemain) {
    EXPECT_TRUE(folds_of_eight(3).empty());
}

/// Every sample once, with all of its tables.
TEST(Gain, HoldsOutEverySampleInTurn) {
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.columns = {{"gap", "m", std::vector<double>(4, 1e-3)}};
    Experiment experiment;
    std::vector<Observation> observations;
    for (const char* sample : {"one", "two", "one", "three"}) {
        table.sample = sample;
        for (std::size_t row = 0; row < 4; ++row) {
            observations.push_back({experiment.measurements.size(), row});
        }
        experiment.measurements.push_back(table);
    }
    const std::vector<std::vector<bool>> folds = choose_folds(experiment, observations, 0.3);
    ASSERT_EQ(folds.size(), 3U);
    for (std::size_t k = 0; k < observations.size(); ++k) {
        int times = 0;
        for (const std::vector<bool>& held : folds) {
            times += held[k] ? 1 : 0;
        }
        EXPECT_EQ(times, 1);
    }
    for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_TRUE(folds[0][row] && folds[0][row + 8]) << "both tables of a sample go together";
    }
}

}  // namespace
}  // namespace coagula::diagnose
