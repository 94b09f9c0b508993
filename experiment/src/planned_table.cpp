// SPDX-License-Identifier: GPL-3.0-or-later
#include "planned_table.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>
#include <numbers>

namespace coagula::experiment {

namespace {

/// An end of a planned axis; an angular frequency may be given in cycles.
double planned_end(TomlKeys& keys, const toml::node& node, const std::string& key, const std::string& unit) {
    const bool in_cycles = unit == "rad/s" && node.is_string() && node.ref<std::string>().ends_with("Hz");
    return in_cycles ? 2 * std::numbers::pi * keys.quantity_of(node, key, "Hz") : keys.quantity_of(node, key, unit);
}

}  // namespace

diagnose::Measurement planned_table(TomlKeys& keys, diagnose::MeasurementKind kind, std::size_t number,
                                    const std::map<std::string, double>& constants) {
    const diagnose::TableRule rule = diagnose::rule_of(kind);
    if (rule.axes.empty()) {
        keys.fail("planned", std::string(diagnose::name_of(kind)) + " has no axis that could be planned");
    }
    if (kind == diagnose::MeasurementKind::waveform) {
        keys.fail("planned", "waveforms are planned as a table of kind harmonics, with the strains of their oscillations");
    }
    if (diagnose::is_step_test(kind)) {
        keys.fail("planned", "a " + std::string(diagnose::name_of(kind)) +
                                 " is planned as a table of kind frequency-sweep, as which it is compared");
    }
    const diagnose::Quantity& axis = *diagnose::find_quantity(rule.axes.front());
    double from = unset;
    double to = unset;
    double points = unset;
    for (const auto& [name, node] : keys.entries("planned")) {
        if (name == "from" || name == "to") {
            (name == "from" ? from : to) = planned_end(keys, *node, "planned." + name, std::string(axis.unit));
        } else if (name == "points") {
            points = keys.quantity_of(*node, "planned.points", "1");
        } else {
            keys.fail("planned", "'" + name + "' is not one of from, to, points");
        }
    }
    if (!(from > 0 && to > 0 && from != to)) {
        keys.fail("planned", "needs 'from' and 'to', two values of " + std::string(axis.name) + " > 0");
    }
    if (!(points >= static_cast<double>(rule.fewest_rows) && points <= 10000 && points == std::floor(points))) {
        keys.fail("planned", "needs 'points', a whole number from " + std::to_string(rule.fewest_rows) + " to 10000");
    }
    diagnose::Measurement table;
    table.kind = kind;
    table.label = "measurement " + std::to_string(number) + " (planned)";
    const auto rows = static_cast<std::size_t>(points);
    diagnose::Column column{std::string(axis.name), std::string(axis.unit), std::vector<double>(rows)};
    for (std::size_t row = 0; row < rows; ++row) {
        const double way = static_cast<double>(row) / (points - 1);
        column.values[row] = axis.name == "time" || axis.name == "gap" ? from + (to - from) * way : from * std::pow(to / from, way);
    }
    table.columns.push_back(std::move(column));
    for (const auto& [name, value] : constants) {
        table.columns.push_back({name, std::string(diagnose::find_quantity(name)->unit), std::vector<double>(rows, value)});
    }
    return table;
}

}  // namespace coagula::experiment
