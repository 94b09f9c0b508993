#include <coagula/experiment/measured_tables.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace coagula::experiment {

namespace {

bool has_numbers(const io::PlainColumn& column) {
    return std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
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
            const io::PlainColumn& column = table_.columns[i];
            if (column.heading == heading || column.heading + " [" + column.unit + "]" == heading) {
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
            if (table_.columns[i].quantity == quantity && !is_claimed(i) && (!found || is_meant_rather(i, *found))) {
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

    std::vector<double> in_si(const io::PlainColumn& column, const diagnose::Quantity& quantity) const {
        const std::string name = "column '" + column.heading + "'";
        const bool may_lack_unit = quantity.name == "loss_tangent" || quantity.name == "coordination" ||
                                   quantity.name == "heterogeneity" || quantity.name == "structure" || quantity.name == "frame" ||
                                   quantity.name == "exclusion_probability";
        if (column.unit.empty() && !may_lack_unit) {
            fail(name + " names no unit; it must be one that converts into " + std::string(quantity.unit) + ", such as '" +
                 column.heading + " [" + std::string(quantity.unit) + "]'");
        }
        // An angular frequency is often given in 1/s, its radian left out.
        const bool radian_left_out =
            quantity.unit == "rad/s" && (column.unit == "1/s" || column.unit == "s^-1" || column.unit == "s-1");
        if (column.unit.empty() || radian_left_out) {
            return column.values;
        }
        try {
            return io::convert(column.values, column.unit, std::string(quantity.unit));
        } catch (const InputError& error) {
            fail(name + ": " + error.what());
        }
    }

    void add_column(const diagnose::Quantity& quantity, std::size_t index) {
        diagnose::Column column{std::string(quantity.name), std::string(quantity.unit), in_si(table_.columns[index], quantity)};
        const auto error = rules_.standard_errors.find(column.name);
        if (error != rules_.standard_errors.end()) {
            column.standard_errors = in_si(table_.columns[find_heading(error->second)], quantity);
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
        const std::string heading = column.heading + (column.unit.empty() ? "" : " [" + column.unit + "]");
        const auto names_it = [&](const auto& entry) { return entry.second == column.heading || entry.second == heading; };
        const bool named = std::any_of(rules.headings.begin(), rules.headings.end(), names_it) ||
                           std::any_of(rules.standard_errors.begin(), rules.standard_errors.end(), names_it);
        if (column.quantity.empty() && !named && has_numbers(column)) {
            headings.push_back("'" + heading + "'");
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
