// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/table.hpp>

#include <coagula/io/structure_file.hpp>
#include <coagula/io/units.hpp>

#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include <coagula/io/atomic_file.hpp>
#include "csv_reader.hpp"

namespace coagula::io {

namespace {

/// What one unit of the column is worth.
double unit_of(const CsvReader& table, const CsvReader::Column& found, const TableColumn& wanted) {
    if (!found.unit.empty()) {
        try {
            return unit_factor(found.unit, wanted.unit);
        } catch (const InputError& error) {
            table.file().fail("column " + found.name + ": " + error.what());
        }
    }
    if (!wanted.default_unit && wanted.unit != "1") {
        table.file().fail("column " + found.name + " names no unit: write " + found.name + " [" + wanted.unit + "]");
    }
    return wanted.default_unit.value_or(1.0);
}

void check_value(const LineReader& file, const TableColumn& column, double value) {
    if (!std::isfinite(value)) {
        file.fail(column.name + " is too large a number in " + column.unit);
    }
    if (value < column.low || value > column.high) {
        const std::string unit = column.unit == "1" ? "" : " " + column.unit;
        file.fail(column.name + " is " + to_text(value) + unit + ", but must be " + to_text(column.low) + " .. " +
                  to_text(column.high) + unit);
    }
}

bool is_number(const std::string& field) {
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc{} && end == field.data() + field.size();
}

/// A spreadsheet takes a text that begins with one of these for a formula and runs it: an apostrophe in front makes it a text.
std::string harmless(const std::string& field) {
    const bool formula = !field.empty() && std::string_view("=+-@\t\r").find(field.front()) != std::string_view::npos;
    return formula && !is_number(field) ? "'" + field : field;
}

std::string quoted(const std::string& field) {
    if (field.find_first_of(",;\t\"\n\r") == std::string::npos) {
        return field;
    }
    std::string text = "\"";
    for (const char c : field) {
        text += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return text + '"';
}

}  // namespace

std::vector<Eigen::VectorXd> read_table(const std::string& path, const std::vector<TableColumn>& columns) {
    LineReader file(path);
    CsvReader table(file);
    std::vector<std::optional<CsvReader::Column>> found;
    std::vector<double> units;
    for (const TableColumn& column : columns) {
        found.push_back(table.find(lower_case(column.name)));
        if (!found.back() && column.required) {
            file.fail("there is no column " + column.name + "; the first line must be a header that names it");
        }
        units.push_back(found.back() ? unit_of(table, *found.back(), column) : 1.0);
    }
    std::vector<std::vector<double>> values(columns.size());
    while (table.next()) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (found[k]) {
                values[k].push_back(table.number(*found[k]) * units[k]);
                check_value(file, columns[k], values[k].back());
            }
        }
    }
    std::vector<Eigen::VectorXd> result;
    result.reserve(values.size());
    for (const std::vector<double>& column : values) {
        result.emplace_back(Eigen::VectorXd::Map(column.data(), static_cast<Index>(column.size())));
    }
    return result;
}

std::vector<std::string> read_text_column(const std::string& path, const std::string& name) {
    LineReader file(path);
    CsvReader table(file);
    const std::optional<CsvReader::Column> column = table.find(lower_case(name));
    if (!column) {
        throw InputError(path + ": there is no column " + name);
    }
    std::vector<std::string> fields;
    while (table.next()) {
        fields.emplace_back(table.text(*column));
    }
    return fields;
}

std::string csv_text(const std::vector<std::vector<std::string>>& rows) {
    std::string out;
    for (const std::vector<std::string>& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            out += (k > 0 ? "," : "") + quoted(harmless(row[k]));
        }
        out += '\n';
    }
    return out;
}

void write_rows(const std::string& path, const std::vector<std::vector<std::string>>& rows, bool overwrite) {
    check_output(path, overwrite);
    write_file(path, csv_text(rows), overwrite);
}

}  // namespace coagula::io
