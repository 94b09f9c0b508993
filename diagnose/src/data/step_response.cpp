// SPDX-License-Identifier: GPL-3.0-or-later
// The response over the step in tables of step tests.
#include <coagula/diagnose/step_test.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "median.hpp"
#include "step_columns.hpp"
#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

namespace coagula::diagnose {

namespace {

/// Strain or stress of a deflection or torque, in the place of another where `raw` is set.
void add_from_tool(Measurement& table, const Instrument& instrument, const char* name, const char* from, bool raw) {
    const Column* source = find_column(table, from);
    if (source == nullptr || (find_column(table, name) != nullptr && !raw)) {
        return;
    }
    Column column{name, std::string(find_quantity(name)->unit), {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const ToolConstants tool =
            tool_constants(instrument, cell(table, "gap", row), cell(table, "plate_radius", row), table.cone_angle);
        column.values.push_back(source->values[row] * (std::string_view(name) == "stress" ? tool.stress : tool.strain));
    }
    if (readable_numbers(&column).empty() && !readable_numbers(source).empty()) {
        if (raw) {
            refuse(table,
                   "a step of the torque or the deflection needs the size of the tool: plate_radius with gap or cone_angle, "
                   "inner_radius, outer_radius and bob_length, or stress_constant and strain_constant in [instrument]");
        }
        return;
    }
    std::erase_if(table.columns, [&](const Column& other) { return other.name == name; });
    table.columns.push_back(std::move(column));
}

/// The stress of viscosity and rate, where no column holds it.
void add_stress_of_flow(Measurement& table) {
    const Column* viscosity = find_column(table, "viscosity");
    if (find_column(table, "stress") != nullptr || viscosity == nullptr) {
        return;
    }
    const Column& rate = *find_column(table, "shear_rate");
    Column stress{"stress", "Pa", {}};
    std::transform(viscosity->values.begin(), viscosity->values.end(), rate.values.begin(), std::back_inserter(stress.values),
                   std::multiplies<>());
    table.columns.push_back(std::move(stress));
}

/// Takes the changes of rate and stress for the rate and the stress; without a column of the rate the flow has stopped.
void take_from_rate(Measurement& table) {
    if (find_column(table, "shear_rate") == nullptr) {
        table.columns.push_back({"shear_rate", "1/s", std::vector<double>(table.rows(), 0.0)});
    }
    add_stress_of_flow(table);
    for (Column& column : table.columns) {
        const bool rate = column.name == "shear_rate";
        if (rate || column.name == "stress") {
            for (double& value : column.values) {
                value -= rate ? table.rate_before : table.stress_before;
            }
        }
    }
    Column& rate =
        *std::find_if(table.columns.begin(), table.columns.end(), [](const Column& one) { return one.name == "shear_rate"; });
    if (median(readable_numbers(&rate)) < 0) {  // a step down is one up of everything turned round
        for (Column& column : table.columns) {
            if (column.name == "shear_rate" || column.name == "stress") {
                std::for_each(column.values.begin(), column.values.end(), [](double& value) { value = -value; });
            }
        }
    }
}

bool is_of_rate(std::string_view name) {
    return name == "shear_rate" || name == "viscosity";
}

}  // namespace

StepColumns step_columns_of(MeasurementKind kind) {
    switch (kind) {
        case MeasurementKind::creep:
            return {"stress", "strain", "compliance", "creep"};
        case MeasurementKind::stress_relaxation:
            return {"strain", "stress", "relaxation_modulus", "stress relaxation"};
        default:
            return {"shear_rate", "stress", "viscosity", "start-up"};
    }
}

void refuse(const Measurement& table, const std::string& rule) {
    throw InputError(table.label + ": " + rule);
}

std::vector<double> readable_numbers(const Column* column) {
    std::vector<double> values;
    if (column != nullptr) {
        std::copy_if(column->values.begin(), column->values.end(), std::back_inserter(values),
                     [](double value) { return std::isfinite(value); });
    }
    return values;
}

void derive_step_response(Measurement& table, const Instrument& instrument, bool raw) {
    if (!is_step_test(table.kind)) {
        return;
    }
    const StepColumns names = step_columns_of(table.kind);
    if (table.kind != MeasurementKind::start_up) {  // what instruments divide by a rate that is none
        std::erase_if(table.columns, [](const Column& column) { return is_of_rate(column.name); });
        std::erase_if(table.left_out, [](const LeftOutCell& cell) { return is_of_rate(cell.column); });
    }
    add_from_tool(table, instrument, "stress", "torque", raw);
    add_from_tool(table, instrument, "strain", "deflection", raw);
    const bool from_a_rate = table.rate_before != 0;
    if (from_a_rate) {
        take_from_rate(table);
    }
    const Column* step = find_column(table, names.step);
    const Column* response = find_column(table, names.response);
    if (step == nullptr || response == nullptr || (find_column(table, names.ratio) != nullptr && !raw && !from_a_rate)) {
        return;
    }
    Column ratio{names.ratio, std::string(find_quantity(names.ratio)->unit), {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double height = step->values[row];
        ratio.values.push_back(height == 0 ? unset : response->values[row] / height);
    }
    const std::vector<double> values = readable_numbers(&ratio);
    if (values.empty() && !readable_numbers(step).empty() && !readable_numbers(response).empty()) {
        refuse(table,
               "'" + std::string(names.step) + "' is 0 in every row, but a " + names.test + " is the answer to a step of it");
    }
    if (!values.empty() && median(values) < 0) {
        refuse(table, "'" + std::string(names.step) + "' and '" + names.response +
                          "' have opposite signs in most rows, but a sample answers to a step in its direction");
    }
    std::erase_if(table.columns, [&](const Column& other) { return other.name == names.ratio; });
    table.columns.push_back(std::move(ratio));
}

}  // namespace coagula::diagnose
