// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are consistent by construction.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace coagula::diagnose {

inline Column& column(Measurement& table, const std::string& name) {
    return *std::ranges::find(table.columns, name, &Column::name);
}

/// An amplitude sweep of `rows` rows with every column that repeats another: G' falls, G'' passes a hump.
inline Measurement amplitude_sweep(std::size_t rows = 20) {
    Measurement table{.kind = MeasurementKind::amplitude_sweep, .label = "sweep.csv", .sample = "A", .columns = {}, .left_out = {}};
    for (const auto& quantity : {"strain", "stress", "storage_modulus", "loss_modulus", "loss_tangent", "phase", "complex_modulus",
                                 "angular_frequency", "complex_viscosity", "torque"}) {
        table.columns.push_back({quantity, std::string(find_quantity(quantity)->unit), std::vector<double>(rows)});
    }
    for (std::size_t row = 0; row < rows; ++row) {
        const double strain = 1e-5 * std::pow(10.0, 4.0 * static_cast<double>(row) / static_cast<double>(rows));
        const double storage = 500 / (1 + strain / 0.01);
        const double loss = 50 + 40 * std::exp(-std::pow(std::log(strain / 0.01), 2));
        const double modulus = std::hypot(storage, loss);
        column(table, "strain").values[row] = strain;
        column(table, "storage_modulus").values[row] = storage;
        column(table, "loss_modulus").values[row] = loss;
        column(table, "stress").values[row] = modulus * strain;
        column(table, "loss_tangent").values[row] = loss / storage;
        column(table, "phase").values[row] = std::atan2(loss, storage);
        column(table, "complex_modulus").values[row] = modulus;
        column(table, "angular_frequency").values[row] = 10;
        column(table, "complex_viscosity").values[row] = modulus / 10;
        column(table, "torque").values[row] = 3e-5 * modulus * strain;
    }
    return table;
}

inline void drop_column(Measurement& table, const std::string& name) {
    std::erase_if(table.columns, [&](const Column& column) { return column.name == name; });
}

}  // namespace coagula::diagnose
