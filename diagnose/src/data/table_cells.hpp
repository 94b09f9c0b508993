// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of a table by name and row.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace coagula::diagnose {

/// NaN where the table has no such column.
inline double cell(const Measurement& table, std::string_view name, std::size_t row) {
    const Column* column = find_column(table, name);
    return column == nullptr ? unset : column->values[row];
}

/// [rad/s]; NaN where the table has neither that nor a frequency.
inline double angular_frequency(const Measurement& table, std::size_t row) {
    const double given = cell(table, "angular_frequency", row);
    return std::isnan(given) ? 2 * std::numbers::pi * cell(table, "frequency", row) : given;
}

/// |G*| of a row; NaN unless both moduli are known.
inline double complex_modulus(const Measurement& table, std::size_t row) {
    return std::hypot(cell(table, "storage_modulus", row), cell(table, "loss_modulus", row));
}

/// Whether two set values are the same, as far as an instrument keeps to them.
inline bool alike(double a, double b) {
    constexpr double same = 0.02;
    return std::abs(a - b) <= same * std::max(std::abs(a), std::abs(b));
}

/// Whether a set value is the same or missing in both.
inline bool identical(double a, double b) {
    return std::isnan(a) ? std::isnan(b) : a == b;
}

/// Whether two tables of the same kind and axis are of the same measurement but for sample and order.
inline bool measured_alike(const Measurement& a, const Measurement& b) {
    return a.rough_plates == b.rough_plates && a.solvent_trap == b.solvent_trap && a.oscillations == b.oscillations &&
           identical(a.cone_angle, b.cone_angle) && identical(a.fluid_viscosity, b.fluid_viscosity) &&
           std::isnan(a.preshear) == std::isnan(b.preshear);
}

}  // namespace coagula::diagnose
