#include "gain.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coagula::diagnose {
namespace {

/// A gap series of eight rows; only those from `first` on are readable.
std::vector<bool> held_out_of_eight(std::size_t first) {
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
    return choose_held_out(experiment, observations, 0.3);
}

TEST(Gain, HoldsOutTheEndOfTheOnlyTable) {
    EXPECT_EQ(held_out_of_eight(2), (std::vector<bool>{false, false, false, false, true, true}));
}

TEST(Gain, HoldsOutNothingWhereFewerThanFourNumbersRemain) {
    EXPECT_EQ(held_out_of_eight(3), std::vector<bool>(5, false));
}

}  // namespace
}  // namespace coagula::diagnose
