// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/measured_tables.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>

namespace coagula::experiment {

namespace {

bool has_numbers(const io::PlainColumn& column) {
    return std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
}

/// The unit in "Gp [Pa]" for a column "Gp" that has none.
std::string added_unit(const io::PlainColumn& column, const std::string& heading) {
    const std::string before = column.heading + " [";
    const bool adds = column.unit.empty() && heading.starts_with(before) && heading.ends_with(']');
    return adds ? heading.substr(before.size(), heading.size() - before.size() - 1) : "";
}

bool is_named(const io::PlainColumn& column, const std::string& heading) {
    return column.heading == heading || column.heading + " [" + column.unit + "]" == heading ||
           !added_unit(column, heading).empty();
}

bool names_it(const std::map<std::string, std::string>& headings, const io::PlainColumn& column) {
    return std::any_of(headings.begin(), headings.end(), [&](const auto& entry) { return is_named(column, entry.second); });
}

bool is_pure_number(std::string_view quantity) {
    return quantity == "loss_tangent" || quantity == "coordination" || quantity == "heterogeneity" || quantity == "structure" ||
           quantity == "frame" || quantity == "exclusion_probability";
}

/// Whether a column without a unit can be done without.
bool is_ignored(const io::PlainTable& table, const io::PlainColumn& column, diagnose::MeasurementKind kind,
                const ColumnRules& rules) {
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(), [&](const char* name) { return column.quantity == name; });
    };
    const bool lacks_unit = column.unit.empty() && !is_pure_number(column.quantity) && !names_it(rules.headings, column) &&
                            !names_it(rules.standard_errors, column);
    const bool moduli =
        diagnose::has_moduli(kind) && std::any_of(table.columns.begin(), table.columns.end(), [](const io::PlainColumn& other) {
            return other.quantity == "storage_modulus" && !other.unit.empty() && has_numbers(other);
        });
    const bool repeats =
        is_one_of({"torque", "deflection", "raw_phase", "phase", "complex_modulus", "complex_viscosity", "stress"});
    return lacks_unit && (is_one_of({"temperature", "normal_force", "rattler_fraction"}) || (moduli && repeats));
}

/// Builds one measurement.
class Converter {
public:
    Converter(const io::PlainTable& table, diagnose::MeasurementKind kind, const std::string& label, const ColumnRules& rules)
        : table_(table), rules_(rules) {
        measurement_.kind = kind;
        measurement_.label = label;
    }

    diagnose::Measurement run() {
        for (const auto& [quantity, heading] : rules_.headings) {
            find_heading(heading);
        }
        for (const diagnose::Quantity& quantity : diagnose::all_quantities()) {
            if (const auto index = column_of(std::string(quantity.name))) {
                refuse_second(*index);
                add_column(quantity, *index);
            }
        }
        for (const auto& [quantity, value] : rules_.constants) {
            add_constant(quantity, value);
        }
        derive_angular_frequency();
        if (measurement_.kind == diagnose::MeasurementKind::waveform) {
            derive_time();
        }
        return std::move(measurement_);
    }

private:
    [[noreturn]] void fail(const std::string& rule) const { throw InputError(measurement_.label + ": " + rule); }

    /// Also with its unit, "G' [Pa]".
    std::size_t find_heading(const std::string& heading) const {
        for (std::size_t i = 0; i < table_.columns.size(); ++i) {
            if (is_named(table_.columns[i], heading)) {
                return i;
            }
        }
        std::string all;
        for (const io::PlainColumn& column : table_.columns) {
            all += (all.empty() ? "'" : ", '") + column.heading + "'";
        }
        fail("there is no column '" + heading + "' with numbers; the columns with numbers are " + all);
    }

    /// Two columns of one heading would leave open which is meant, unless they say the same.
    void refuse_second(std::size_t index) const {
        const io::PlainColumn& chosen = table_.columns[index];
        for (std::size_t i = 0; i < table_.columns.size(); ++i) {
            const io::PlainColumn& other = table_.columns[i];
            if (i != index && other.heading == chosen.heading && other.unit == chosen.unit && has_numbers(other) &&
                !same_values(other.values, chosen.values)) {
                fail("two columns have the heading '" + chosen.heading + "' and differ; change one of them");
            }
        }
    }

    std::optional<std::size_t> column_of(const std::string& quantity) const {
        if (const auto named = rules_.headings.find(quantity); named != rules_.headings.end()) {
            return find_heading(named->second);
        }
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < table_.columns.size(); ++i) {
            const io::PlainColumn& column = table_.columns[i];
            const bool means_it =
                column.quantity == quantity && !is_claimed(i) && !is_ignored(table_, column, measurement_.kind, rules_);
            if (means_it && (!found || is_meant_rather(i, *found))) {
                found = i;
            }
        }
        return found;
    }

    /// Of two columns with one meaning: the one with numbers, and of these the more special one.
    bool is_meant_rather(std::size_t one, std::size_t other) const {
        const bool numbers = has_numbers(table_.columns[one]);
        const bool others = has_numbers(table_.columns[other]);
        return numbers != others ? numbers : table_.columns[one].rank < table_.columns[other].rank;
    }

    /// Whether the experiment file gives the column another meaning.
    bool is_claimed(std::size_t index) const {
        const auto claims = [&](const auto& entry) { return find_heading(entry.second) == index; };
        return std::any_of(rules_.headings.begin(), rules_.headings.end(), claims) ||
               std::any_of(rules_.standard_errors.begin(), rules_.standard_errors.end(), claims);
    }

    /// All columns that lack a unit as an experiment file names them, with SI units to begin with.
    std::string columns_without_unit() const {
        std::string list;
        for (const io::PlainColumn& column : table_.columns) {
            const diagnose::Quantity* quantity = diagnose::find_quantity(column.quantity);
            if (quantity != nullptr && column.unit.empty() && has_numbers(column) && !is_pure_number(quantity->name)) {
                list += (list.empty() ? "" : ", ") + column.quantity + " = \"" + column.heading + " [" +
                        std::string(quantity->unit) + "]\"";
            }
        }
        return list;
    }

    /// @param rules where the experiment file may name the column.
    std::vector<double> in_si(const io::PlainColumn& column, const diagnose::Quantity& quantity,
                              const std::map<std::string, std::string>& rules) const {
        const std::string name = "column '" + column.heading + "'";
        const auto rule = rules.find(std::string(quantity.name));
        const std::string unit = column.unit.empty() && rule != rules.end() ? added_unit(column, rule->second) : column.unit;
        if (unit.empty() && !is_pure_number(quantity.name)) {
            fail(name + " names no unit; it must be one that converts into " + std::string(quantity.unit) +
                 ": write it into the file or into the experiment file, columns = { " + columns_without_unit() + " }");
        }
        // An angular frequency is often given in 1/s, its radian left out.
        const bool radian_left_out = quantity.unit == "rad/s" && (unit == "1/s" || unit == "s^-1" || unit == "s-1");
        if (unit.empty() || radian_left_out) {
            return column.values;
        }
        try {
            return io::convert(column.values, unit, std::string(quantity.unit));
        } catch (const InputError& error) {
            fail(name + ": " + error.what());
        }
    }

    void add_column(const diagnose::Quantity& quantity, std::size_t index) {
        diagnose::Column column{std::string(quantity.name), std::string(quantity.unit),
                                in_si(table_.columns[index], quantity, rules_.headings)};
        const auto error = rules_.standard_errors.find(column.name);
        if (error != rules_.standard_errors.end()) {
            column.standard_errors = in_si(table_.columns[find_heading(error->second)], quantity, rules_.standard_errors);
        }
        for (const io::UnreadableCell& cell : table_.unreadable) {
            if (cell.column == index) {
                measurement_.left_out.push_back({column.name, cell.row, cell.text, cell.reason});
            }
        }
        measurement_.columns.push_back(std::move(column));
    }

    void add_constant(const std::string& name, double value) {
        if (diagnose::find_column(measurement_, name) != nullptr) {
            fail("'" + name + "' is given as a value, but the table has a column of it");
        }
        const diagnose::Quantity& quantity = *diagnose::find_quantity(name);
        measurement_.columns.push_back({name, std::string(quantity.unit), std::vector<double>(table_.rows(), value)});
    }

    void derive_angular_frequency() {
        const diagnose::Column* frequency = diagnose::find_column(measurement_, "frequency");
        if (frequency == nullptr || diagnose::find_column(measurement_, "angular_frequency") != nullptr) {
            return;
        }
        diagnose::Column angular{"angular_frequency", "rad/s", frequency->values};
        std::for_each(angular.values.begin(), angular.values.end(), [](double& value) { value *= 2 * std::numbers::pi; });
        measurement_.columns.push_back(std::move(angular));
    }

    void derive_time() {
        const diagnose::Column* frequency = diagnose::find_column(measurement_, "angular_frequency");
        const diagnose::Column* strain = diagnose::find_column(measurement_, "strain");
        if (diagnose::find_column(measurement_, "time") != nullptr || strain == nullptr || strain->values.size() < 2) {
            return;
        }
        if (frequency == nullptr) {
            fail("the waveform has no clock: give its angular frequency, values = { angular_frequency = \"10 rad/s\" }");
        }
        // Exports may repeat the first sample at the end.
        const bool closed = strain->values.front() == strain->values.back();
        const auto steps = static_cast<double>(strain->values.size() - (closed ? 1 : 0));
        diagnose::Column time{"time", "s", strain->values};
        for (std::size_t i = 0; i < time.values.size(); ++i) {
            time.values[i] = 2 * std::numbers::pi / frequency->values[i] * static_cast<double>(i) / steps;
        }
        measurement_.columns.push_back(std::move(time));
    }

    const io::PlainTable& table_;
    const ColumnRules& rules_;
    diagnose::Measurement measurement_;
};

}  // namespace

std::vector<std::string> not_understood(const io::PlainTable& table, const ColumnRules& rules) {
    std::vector<std::string> headings;
    for (const io::PlainColumn& column : table.columns) {
        if (column.quantity.empty() && has_numbers(column) && !names_it(rules.headings, column) &&
            !names_it(rules.standard_errors, column)) {
            headings.push_back("'" + column.heading + (column.unit.empty() ? "" : " [" + column.unit + "]") + "'");
        }
    }
    return headings;
}

std::vector<std::string> ignored_columns(const io::PlainTable& table, diagnose::MeasurementKind kind, const ColumnRules& rules) {
    std::vector<std::string> headings;
    for (const io::PlainColumn& column : table.columns) {
        if (has_numbers(column) && is_ignored(table, column, kind, rules)) {
            headings.push_back("'" + column.heading + "'");
        }
    }
    return headings;
}

bool same_values(const std::vector<double>& one, const std::vector<double>& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

diagnose::Measurement to_measurement(const io::PlainTable& table, diagnose::MeasurementKind kind, const std::string& label,
                                     const ColumnRules& rules) {
    return Converter(table, kind, label, rules).run();
}

}  // namespace coagula::experiment
