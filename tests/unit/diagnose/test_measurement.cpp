// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/measurement.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace coagula::diagnose {
namespace {

TEST(Measurement, KindsAndGeometriesHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const MeasurementKind kind : all_measurement_kinds()) {
        EXPECT_EQ(measurement_kind(name_of(kind)), kind);
        names.insert(name_of(kind));
    }
    EXPECT_EQ(names.size(), 14U);
    EXPECT_FALSE(measurement_kind("sweep"));
    EXPECT_EQ(geometry("cone-plate"), Geometry::cone_plate);
    EXPECT_FALSE(geometry("couette"));
}

TEST(Measurement, EveryRequiredColumnIsAQuantity) {
    for (const MeasurementKind kind : all_measurement_kinds()) {
        const TableRule rule = rule_of(kind);
        for (const std::string_view name : rule.axes) {
            EXPECT_NE(find_quantity(name), nullptr) << name;
        }
        for (const std::string_view name : rule.required) {
            EXPECT_NE(find_quantity(name), nullptr) << name;
        }
        EXPECT_GT(rule.fewest_rows, 3U);  // a table of three points says nothing
    }
}

std::string refusal(const Experiment& experiment) {
    try {
        check(experiment);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Experiment, RefusesMetadataThatContradictThemselves) {
    EXPECT_EQ(refusal({}), "");
    Experiment experiment;
    experiment.instrument.gap = 0;
    EXPECT_EQ(refusal(experiment), "instrument.gap is 0, but must be > 0 m");
    experiment.instrument.gap = 1e300;
    EXPECT_EQ(refusal(experiment), "instrument.gap is 1e+300, but must lie between 1e-30 and 1e+30 m");
    experiment.instrument.gap = 0.02;
    experiment.instrument.plate_radius = 0.0125;
    EXPECT_NE(refusal(experiment).find("must be below plate_radius"), std::string::npos);
    experiment.instrument = {.geometry = Geometry::concentric_cylinders, .inner_radius = 0.0135, .outer_radius = 0.0133};
    EXPECT_NE(refusal(experiment).find("must exceed inner_radius"), std::string::npos);
    experiment.instrument = {.geometry = Geometry::plate_plate, .cone_angle = 0.02};
    EXPECT_NE(refusal(experiment).find("cone_angle is given, but a plate-plate geometry has none"), std::string::npos);
    experiment.instrument = {};
    experiment.sample.volume_fraction = 40;
    EXPECT_NE(refusal(experiment).find("sample.volume_fraction is 40"), std::string::npos);
    experiment.sample.volume_fraction = 0.4;
    experiment.structures = {"a.h5"};
    experiment.recipe = StructureRecipe{};
    EXPECT_NE(refusal(experiment).find("both as files and as a recipe"), std::string::npos);
}

TEST(Experiment, RefusesInfiniteNumbers) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Experiment experiment;
    experiment.measurements.resize(1);
    experiment.measurements[0].label = "a.csv";
    experiment.measurements[0].columns = {{"time", "s", {1, unset, infinite}}};
    EXPECT_EQ(refusal(experiment), "a.csv: 'time' is infinite in row 3; check the values and units that it follows from");
    experiment.measurements[0].columns[0] = {"time", "s", {1, 2, unset}, {0.1, -infinite, 0.1}};
    EXPECT_EQ(refusal(experiment), "a.csv: 'time' is infinite in row 2; check the values and units that it follows from");
    experiment.measurements[0].columns[0].standard_errors = {0.1, unset, 0.1};
    EXPECT_EQ(refusal(experiment), "");
}

}  // namespace
}  // namespace coagula::diagnose
