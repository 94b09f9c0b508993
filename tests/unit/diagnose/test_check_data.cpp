// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/check_data.hpp>

#include "example_sweeps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

namespace coagula::diagnose {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::set<std::string> left_out_columns(const CheckedMeasurement& checked) {
    std::set<std::string> names;
    for (const LeftOutCell& cell : checked.measurement.left_out) {
        names.insert(cell.column);
    }
    return names;
}

/// Expects one problem that contains this part.
void expect_problem(const Measurement& table, const std::string& part) {
    const CheckedMeasurement checked = check_data(table);
    ASSERT_FALSE(checked.problems.empty()) << part;
    EXPECT_NE(checked.problems.front().find(part), std::string::npos) << checked.problems.front();
    EXPECT_TRUE(checked.problems.front().starts_with(table.label + ": ")) << checked.problems.front();
}

TEST(CheckData, LeavesConsistentDataAsTheyAre) {
    const Measurement table = amplitude_sweep();
    const CheckedMeasurement checked = check_data(table);
    EXPECT_TRUE(checked.problems.empty());
    EXPECT_TRUE(checked.measurement.left_out.empty());
    EXPECT_EQ(checked.relations.size(), 7U);
    for (const RelationResult& relation : checked.relations) {
        EXPECT_EQ(relation.rows, 20U) << relation.name;
        EXPECT_EQ(relation.failed, 0U) << relation.name;
    }
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        EXPECT_EQ(checked.measurement.columns[i].values, table.columns[i].values);
    }
}

/// One wrong cell in a table where every column is repeated by others is found, and it alone is left out; of a wrong modulus the
/// other part may go too, because every relation that fails has both.
TEST(CheckData, FindsTheOneWrongCellInAnyColumn) {
    for (const std::string name :
         {"stress", "storage_modulus", "loss_modulus", "loss_tangent", "phase", "complex_modulus", "complex_viscosity", "torque"}) {
        for (const double factor : {10.0, 0.1, 1000.0}) {
            Measurement table = amplitude_sweep();
            column(table, name).values[7] *= factor;
            const CheckedMeasurement checked = check_data(table);
            ASSERT_TRUE(checked.problems.empty()) << name;
            std::set<std::string> found = left_out_columns(checked);
            EXPECT_EQ(found.count(name), 1U) << name << ' ' << factor;
            found.erase(name);
            if (name == "storage_modulus" || name == "loss_modulus") {
                found.erase("storage_modulus");
                found.erase("loss_modulus");
            }
            EXPECT_TRUE(found.empty()) << name << ' ' << factor << ": " << *found.begin();
            for (const LeftOutCell& cell : checked.measurement.left_out) {
                EXPECT_EQ(cell.row, 7U);
                EXPECT_FALSE(cell.reason.empty());
                EXPECT_TRUE(std::isnan(find_column(checked.measurement, cell.column)->values[7]));
            }
        }
    }
}

/// A loss modulus hardly matters to |G*|, so that relations of |G*| do not vouch for it: tan delta and phase accuse it together.
TEST(CheckData, ASmallLossModulusIsNotVouchedForByTheModulus) {
    Measurement table = amplitude_sweep();
    column(table, "loss_modulus").values[2] *= 0.1;
    const CheckedMeasurement checked = check_data(table);
    ASSERT_EQ(checked.measurement.left_out.size(), 1U);
    EXPECT_EQ(checked.measurement.left_out[0].column, "loss_modulus");
}

/// Without a second witness it cannot be told which cell of a failing relation is wrong: all go that nothing vouches for.
TEST(CheckData, LeavesOutAllSuspectsWhereNobodyVouches) {
    Measurement table = amplitude_sweep();
    for (const char* name : {"torque", "loss_tangent", "phase", "complex_modulus", "complex_viscosity"}) {
        drop_column(table, name);
    }
    column(table, "stress").values[3] *= 10;
    EXPECT_EQ(left_out_columns(check_data(table)), (std::set<std::string>{"stress", "storage_modulus", "loss_modulus"}));
    // The strain steps evenly and so vouches for itself; uneven steps do not.
    column(table, "strain").values[10] *= 1.2;
    column(table, "stress").values[10] *= 1.2;
    EXPECT_EQ(left_out_columns(check_data(table)), (std::set<std::string>{"strain", "stress", "storage_modulus", "loss_modulus"}));
}

TEST(CheckData, ARunOfSlippedSeparatorsDoesNotVouchForItself) {
    Measurement table = amplitude_sweep(40);
    for (std::size_t row = 20; row < 35; ++row) {
        column(table, "stress").values[row] *= 10;
    }
    const CheckedMeasurement checked = check_data(table);
    EXPECT_EQ(left_out_columns(checked), std::set<std::string>{"stress"});
    EXPECT_EQ(checked.measurement.left_out.size(), 15U);
}

TEST(CheckData, ToleratesPeakStressesOfAPlasticSampleInAmplitudeSweepsOnly) {
    Measurement table = amplitude_sweep();
    drop_column(table, "torque");
    for (std::size_t row = 12; row < 20; ++row) {
        column(table, "stress").values[row] *= 3.14159 / 4;
    }
    EXPECT_TRUE(check_data(table).measurement.left_out.empty());
    table.kind = MeasurementKind::frequency_sweep;
    for (std::size_t row = 0; row < 20; ++row) {
        column(table, "angular_frequency").values[row] = 1.0 + static_cast<double>(row);
        column(table, "complex_viscosity").values[row] =
            column(table, "complex_modulus").values[row] / column(table, "angular_frequency").values[row];
    }
    EXPECT_EQ(left_out_columns(check_data(table)).count("stress"), 1U);
}

TEST(CheckData, NamesAWrongUnit) {
    Measurement table = amplitude_sweep();
    drop_column(table, "torque");
    for (double& strain : column(table, "strain").values) {
        strain *= 100;  // per cent taken for numbers
    }
    expect_problem(table, "|G*| x strain = stress fails in 20 of 20 rows, typically by a factor of 100: are the units");
}

TEST(CheckData, RefusesModuliThatNothingHas) {
    for (const double factor : {1e-20, 1e20}) {
        Measurement table = amplitude_sweep();
        std::vector<double>& values = column(table, "storage_modulus").values;
        std::for_each(values.begin(), values.end(), [&](double& value) { value *= factor; });
        expect_problem(table, "from 1e-9 to 1e15 Pa is possible");
    }
}

/// What a heavy tool shows at a high frequency.
TEST(CheckData, AcceptsModuliBelowZero) {
    Measurement table;
    table.label = "raw";
    table.columns = {{"angular_frequency", "rad/s", {1, 10, 50, 100, 200}},
                     {"storage_modulus", "Pa", {9e4, 8e4, -5e4, -4e5, -2e6}}};
    const CheckedMeasurement checked = check_data(table);
    EXPECT_TRUE(checked.problems.empty());
    EXPECT_TRUE(checked.measurement.left_out.empty());
}

TEST(CheckData, DropsARedundantColumnThatContradictsThroughout) {
    Measurement table = amplitude_sweep();
    for (double& viscosity : column(table, "complex_viscosity").values) {
        viscosity *= 1000;
    }
    const CheckedMeasurement checked = check_data(table);
    EXPECT_TRUE(checked.problems.empty());
    EXPECT_EQ(left_out_columns(checked), std::set<std::string>{"complex_viscosity"});
    EXPECT_EQ(checked.measurement.left_out.size(), 20U);
}

TEST(CheckData, WantsTheColumnsOfTheKind) {
    Measurement table = amplitude_sweep();
    drop_column(table, "strain");
    expect_problem(table, "there is no column 'strain'");
    table = amplitude_sweep();
    drop_column(table, "storage_modulus");
    expect_problem(table, "there is no column 'storage_modulus'");
    table = amplitude_sweep();
    table.kind = MeasurementKind::time_sweep;
    expect_problem(table, "there is no column 'time'");
    table.kind = MeasurementKind::structure_series;
    expect_problem(table, "'heterogeneity' or 'coordination' or 'volume_fraction'");
}

TEST(CheckData, RefusesOtherUnitsThanSI) {
    Measurement table = amplitude_sweep();
    column(table, "stress").unit = "kPa";
    EXPECT_THROW(check_data(table), std::invalid_argument);
}

TEST(CheckData, SaysThatThreePointsAreTooFew) {
    expect_problem(amplitude_sweep(3), "3 usable rows are too few: a table of kind amplitude-sweep needs at least 5");
}

TEST(CheckData, SaysThatNothingIsReadable) {
    Measurement table = amplitude_sweep();
    column(table, "storage_modulus").values.assign(20, nothing);
    expect_problem(table, "column 'storage_modulus' has no readable number");
}

TEST(CheckData, SaysThatConstantDataAreNoMeasurement) {
    Measurement table = amplitude_sweep();
    table.columns.resize(1);
    table.columns.push_back({"storage_modulus", "Pa", std::vector<double>(20, 500.0)});
    expect_problem(table, "column 'storage_modulus' is 500 Pa in every row");
}

TEST(CheckData, AcceptsDescendingSweepsAndRefusesShuffledOnes) {
    Measurement table = amplitude_sweep();
    for (Column& each : table.columns) {
        std::reverse(each.values.begin(), each.values.end());
    }
    EXPECT_TRUE(check_data(table).problems.empty());
    for (Column& each : table.columns) {
        std::rotate(each.values.begin(), each.values.begin() + 7, each.values.end());
    }
    expect_problem(table, "the rows are in the wrong order: 7 of 20 values of 'strain'");
}

/// Gaps that are set in no order tell a drift in time from what follows the gap, and the first gap again at the end does.
TEST(CheckData, GapsComeInAnyOrder) {
    Measurement series;
    series.kind = MeasurementKind::gap_series;
    series.label = "series";
    series.columns = {{"gap", "m", {1e-3, 3e-4, 2e-3, 5e-4, 1.5e-3, 1e-3}}, {"storage_modulus", "Pa", {100, 90, 105, 95, 101, 99}}};
    const CheckedMeasurement checked = check_data(series);
    EXPECT_TRUE(checked.problems.empty());
    EXPECT_TRUE(checked.measurement.left_out.empty());
}

TEST(CheckData, TimeRunsForwards) {
    Measurement table = amplitude_sweep();
    table.kind = MeasurementKind::time_sweep;
    table.columns.push_back({"time", "s", {}});
    for (std::size_t row = 0; row < 20; ++row) {
        table.columns.back().values.push_back(20.0 - static_cast<double>(row));
    }
    expect_problem(table, "wrong order");
}

TEST(CheckData, LeavesOutOneStepBackOnTheAxis) {
    Measurement table = amplitude_sweep();
    std::swap(column(table, "strain").values[4], column(table, "strain").values[5]);
    const CheckedMeasurement checked = check_data(table);
    EXPECT_TRUE(checked.problems.empty());
    EXPECT_EQ(std::count_if(checked.measurement.left_out.begin(), checked.measurement.left_out.end(),
                            [](const LeftOutCell& cell) { return cell.reason == "breaks the direction of the axis"; }),
              1);
}

TEST(CheckData, LeavesOutImpossibleValues) {
    Measurement table = amplitude_sweep();
    drop_column(table, "complex_viscosity");
    column(table, "angular_frequency").values[2] = -10;
    column(table, "strain").values[0] = 0;
    const CheckedMeasurement checked = check_data(table);
    EXPECT_TRUE(std::isnan(find_column(checked.measurement, "angular_frequency")->values[2]));
    EXPECT_TRUE(std::isnan(find_column(checked.measurement, "strain")->values[0]));
    EXPECT_EQ(checked.measurement.left_out.size(), 2U);
}

}  // namespace
}  // namespace coagula::diagnose
