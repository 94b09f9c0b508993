// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/tool_constants.hpp>

#include "table_cells.hpp"

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

ToolConstants of_cylinders(const Instrument& instrument) {
    const double inner = instrument.inner_radius * instrument.inner_radius;
    const double outer = instrument.outer_radius * instrument.outer_radius;
    return {1 / (2 * pi * inner * instrument.bob_length * instrument.end_correction), 2 * outer / (outer - inner)};
}

/// Unset: those of the instrument.
ToolConstants constants_by_size(const Instrument& instrument, double gap, double plate_radius, double cone_angle) {
    if (instrument.geometry == Geometry::concentric_cylinders) {
        return of_cylinders(instrument);
    }
    const double radius = std::isfinite(plate_radius) ? plate_radius : instrument.plate_radius;
    const bool cone = instrument.geometry ? instrument.geometry == Geometry::cone_plate : std::isfinite(instrument.cone_angle);
    const double angle = std::isfinite(cone_angle) ? cone_angle : instrument.cone_angle;
    if (cone || std::isfinite(cone_angle)) {
        return {3 / (2 * pi * std::pow(radius, 3)), 1 / angle};
    }
    return {2 / (pi * std::pow(radius, 3)), radius / (std::isfinite(gap) ? gap : instrument.gap)};
}

bool has(const Measurement& table, const char* name) {
    return find_column(table, name) != nullptr;
}

/// Constants for each row of a table.
ToolConstants constants_in(const Measurement& table, const Instrument& instrument, std::size_t row) {
    return tool_constants(instrument, cell(table, "gap", row), cell(table, "plate_radius", row), table.cone_angle);
}

void replace_column(Measurement& table, const std::string& name, const std::function<double(std::size_t)>& value) {
    Column column{name, std::string(find_quantity(name)->unit), {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        column.values.push_back(value(row));
    }
    std::erase_if(table.columns, [&](const Column& other) { return other.name == name; });
    table.columns.push_back(std::move(column));
}

/// |G*| and its phase, row by row.
struct PolarModulus {
    std::function<double(std::size_t)> size;
    std::function<double(std::size_t)> phase;
    const char* divisor = "";  ///< column without which there is no size where it is 0
};

/// Modulus from torque and deflection; its functions are empty where something is missing.
PolarModulus by_torque(const Measurement& table, const Instrument& instrument) {
    const char* phase = has(table, "raw_phase") ? "raw_phase" : "phase";
    if (!has(table, "torque") || !has(table, "deflection") || !has(table, phase)) {
        return {};
    }
    return {[&, instrument](std::size_t row) {
                return std::abs(cell(table, "torque", row) / cell(table, "deflection", row)) /
                       constants_in(table, instrument, row).torque_per_modulus();
            },
            [&, phase](std::size_t row) { return cell(table, phase, row); }, "deflection"};
}

PolarModulus by_stress(const Measurement& table) {
    const bool tangent = !has(table, "phase") && has(table, "loss_tangent");
    PolarModulus polar;
    if (has(table, "complex_modulus")) {
        polar.size = [&](std::size_t row) { return cell(table, "complex_modulus", row); };
    } else if (has(table, "stress") && has(table, "strain")) {
        polar.size = [&](std::size_t row) { return std::abs(cell(table, "stress", row) / cell(table, "strain", row)); };
        polar.divisor = "strain";
    } else if (has(table, "complex_viscosity") && has(table, "angular_frequency")) {
        polar.size = [&](std::size_t row) { return cell(table, "complex_viscosity", row) * cell(table, "angular_frequency", row); };
    }
    if (!polar.size || !(has(table, "phase") || tangent)) {
        return {};
    }
    polar.phase = [&, tangent](std::size_t row) {
        return tangent ? std::atan(cell(table, "loss_tangent", row)) : cell(table, "phase", row);
    };
    return polar;
}

void require_constants(const Measurement& table, const Instrument& instrument) {
    if (table.rows() > 0 && std::isnan(constants_in(table, instrument, 0).torque_per_modulus())) {
        throw InputError(
            table.label +
            ": moduli of torque and deflection need the size of the tool: plate_radius with gap or cone_angle, inner_radius, "
            "outer_radius and bob_length, or stress_constant and strain_constant in [instrument]");
    }
}

}  // namespace

ToolConstants tool_constants(const Instrument& instrument) {
    return tool_constants(instrument, unset, unset, unset);
}

ToolConstants tool_constants(const Instrument& instrument, double gap, double plate_radius, double cone_angle) {
    const ToolConstants by_size = constants_by_size(instrument, gap, plate_radius, cone_angle);
    const bool own = std::isfinite(cone_angle) || std::isfinite(plate_radius) || std::isfinite(gap);
    const bool known = std::isfinite(by_size.torque_per_modulus());
    return std::isfinite(instrument.stress_constant) && !(own && known)
               ? ToolConstants{instrument.stress_constant, instrument.strain_constant}
               : by_size;
}

void derive_moduli(Measurement& table, const Instrument& instrument, bool raw) {
    const bool given = has(table, "storage_modulus") || has(table, "loss_modulus");
    const bool size_given = (has(table, "complex_modulus") || has(table, "complex_viscosity")) && by_stress(table).size;
    PolarModulus polar = (given || size_given) && !raw ? PolarModulus{} : by_torque(table, instrument);
    if (raw && !polar.size) {
        throw InputError(table.label + ": raw moduli need the columns torque, deflection and raw_phase (or phase)");
    }
    if (polar.size) {
        require_constants(table, instrument);
        if (!has(table, "strain")) {
            replace_column(table, "strain", [&](std::size_t row) {
                return std::abs(cell(table, "deflection", row)) * constants_in(table, instrument, row).strain;
            });
        }
    } else if (!given) {
        polar = by_stress(table);
    }
    if (!polar.size) {
        return;
    }
    std::vector<std::complex<double>> moduli;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const bool divides = cell(table, polar.divisor, row) != 0;
        const double phase = polar.phase(row);  // an impossible one is left out by the check
        moduli.push_back(divides && std::abs(phase) <= 2 * pi ? std::polar(1.0, phase) * polar.size(row)
                                                              : std::complex(unset, unset));
        if (!divides) {
            table.left_out.push_back({polar.divisor, row, "0", "must not be 0: the moduli are divided by it"});
        }
    }
    replace_column(table, "storage_modulus", [&](std::size_t row) { return moduli[row].real(); });
    replace_column(table, "loss_modulus", [&](std::size_t row) { return moduli[row].imag(); });
    if (raw) {
        // Those that the instrument has corrected contradict these.
        std::erase_if(table.columns, [](const Column& column) {
            return column.name == "complex_modulus" || column.name == "loss_tangent" || column.name == "complex_viscosity" ||
                   column.name == "phase" || column.name == "stress";
        });
    }
}

}  // namespace coagula::diagnose
