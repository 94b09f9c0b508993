// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace coagula::experiment {

namespace {

constexpr std::size_t most_listed = 20;  ///< tables that a message names

std::string list_of(const std::vector<const io::PlainTable*>& tables) {
    std::string list;
    for (std::size_t i = 0; i < std::min(tables.size(), most_listed); ++i) {
        const io::PlainTable& table = *tables[i];
        list += (i == 0 ? "" : "; ") + std::to_string(table.number) + ": section " + std::to_string(table.section) +
                (table.title.empty() ? "" : " of '" + table.title + "'") +
                (table.test.empty() ? "" : " of test '" + table.test + "'") + ", " + std::to_string(table.rows()) + " rows";
    }
    return list + (tables.size() > most_listed ? "; ..." : "");
}

/// The tables, waveforms aside, that the keys section, result, test and table name.
std::vector<const io::PlainTable*> fitting_tables(TomlKeys& keys, const io::MeasuredFile& file) {
    const auto section = keys.whole("section");
    const auto result = keys.text("result");
    const auto test = keys.text("test");
    const std::vector<std::int64_t> range = keys.wholes("table");
    if (range.size() > 2 || (!range.empty() && (range.front() < 1 || range.back() < range.front()))) {
        keys.fail("table", "must be a number from 1, or [first, last]");
    }
    std::vector<const io::PlainTable*> all;
    std::vector<const io::PlainTable*> fitting;
    for (const io::PlainTable& table : file.tables) {
        if (table.point != 0) {
            continue;
        }
        all.push_back(&table);
        const bool in_range = range.empty() || (table.number >= range.front() && table.number <= range.back());
        if (in_range && (!section || table.section == *section) && (!result || table.title == *result) &&
            (!test || table.test == *test)) {
            fitting.push_back(&table);
        }
    }
    if (fitting.empty() || (fitting.size() > 1 && range.size() < 2)) {
        const std::string what = fitting.empty() ? "no section fits" : "several sections fit";
        throw InputError(file.path + ": " + what +
                         " the keys of the measurement; choose by table = number, table = [first, last], test, " +
                         "result or section from " + list_of(fitting.empty() ? all : fitting));
    }
    return fitting;
}

void set_clock(diagnose::Measurement& table, const TableSelection& selection) {
    const auto time = std::find_if(table.columns.begin(), table.columns.end(), [](const auto& one) { return one.name == "time"; });
    const bool there = time != table.columns.end();
    if (std::isfinite(selection.time_per_row)) {
        if (there) {
            throw InputError(table.label + ": 'time_per_row' is given, but the table has a column of times");
        }
        diagnose::Column clock{"time", "s", {}};
        for (std::size_t row = 1; row <= table.rows(); ++row) {
            clock.values.push_back(static_cast<double>(row) * selection.time_per_row);
        }
        table.columns.push_back(std::move(clock));
    } else if (selection.time_zero != 0 && !there) {
        throw InputError(table.label + ": 'time_zero' is given, but the table has no times");
    } else if (there) {
        for (double& value : time->values) {
            value -= selection.time_zero;
        }
    }
}

/// Whether the table had it.
bool drop_column(diagnose::Measurement& table, const std::string& name) {
    std::erase_if(table.left_out, [&](const diagnose::LeftOutCell& cell) { return cell.column == name; });
    return std::erase_if(table.columns, [&](const diagnose::Column& column) { return column.name == name; }) > 0;
}

void keep(std::vector<double>& values, const std::vector<std::size_t>& rows) {
    std::vector<double> kept;
    for (std::size_t k = 0; k < rows.size() && !values.empty(); ++k) {
        kept.push_back(values[rows[k]]);
    }
    values = std::move(kept);
}

}  // namespace

std::vector<const io::PlainTable*> chosen_tables(TomlKeys& keys, const io::MeasuredFile& file, diagnose::MeasurementKind kind) {
    std::vector<const io::PlainTable*> tables = fitting_tables(keys, file);
    const std::vector<std::int64_t> points = keys.wholes("points");
    if (kind != diagnose::MeasurementKind::waveform) {
        if (!points.empty()) {
            keys.fail("points", "only a waveform has points");
        }
        return tables;
    }
    std::vector<const io::PlainTable*> waveforms;
    for (const io::PlainTable& table : file.tables) {
        const bool here = std::any_of(tables.begin(), tables.end(), [&](const auto* each) { return each->number == table.number; });
        if (table.point > 0 && here && (points.empty() || std::find(points.begin(), points.end(), table.point) != points.end())) {
            waveforms.push_back(&table);
        }
    }
    if (!points.empty() && waveforms.size() != points.size() * tables.size()) {
        keys.fail("points", file.path + " has no waveform for some of these points");
    }
    return waveforms.empty() ? tables : waveforms;
}

std::string label_of(const io::MeasuredFile& file, const io::PlainTable& table, const std::string& name) {
    if (file.tables.size() == 1) {
        return name;
    }
    const bool section_tells = std::none_of(file.tables.begin(), file.tables.end(), [&](const io::PlainTable& other) {
        return other.section == table.section && other.number != table.number;
    });
    return name + (section_tells ? ", section " + std::to_string(table.section) : ", table " + std::to_string(table.number)) +
           (table.point > 0 ? ", point " + std::to_string(table.point) : "");
}

TableSelection read_selection(TomlKeys& keys) {
    TableSelection selection;
    const std::vector<std::int64_t> rows = keys.wholes("rows");
    if (!rows.empty()) {
        if (rows.size() < 2 || rows.size() > 3 || rows[0] < 1 || rows[1] < rows[0] || (rows.size() == 3 && rows[2] < 1)) {
            keys.fail("rows", "must be [first, last] or [first, last, step], counted from 1, first not after last");
        }
        selection.first = rows[0];
        selection.last = rows[1];
        selection.step = rows.size() == 3 ? rows[2] : 1;
    }
    selection.without = keys.texts("without");
    selection.time_per_row = keys.quantity("time_per_row", "s").value_or(unset);
    if (selection.time_per_row <= 0) {
        keys.fail("time_per_row", "must be > 0 s");
    }
    selection.time_zero = keys.quantity("time_zero", "s").value_or(0);
    return selection;
}

void select(diagnose::Measurement& table, const TableSelection& selection) {
    set_clock(table, selection);
    if (table.rows() == 0) {
        throw InputError(table.label + ": there are no rows below the header");
    }
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto number = static_cast<std::int64_t>(row) + 1;
        if (number >= selection.first && number <= selection.last && (number - selection.first) % selection.step == 0) {
            rows.push_back(row);
        }
    }
    if (rows.empty()) {
        throw InputError(table.label + ": none of its " + std::to_string(table.rows()) + " rows is among those chosen");
    }
    if (selection.last != TableSelection{}.last && selection.last > static_cast<std::int64_t>(table.rows())) {
        throw InputError(table.label + ": rows up to " + std::to_string(selection.last) + " are chosen, but it has " +
                         std::to_string(table.rows()));
    }
    std::map<std::size_t, std::size_t> place;  // of a row among those that remain
    for (const std::size_t row : rows) {
        place.emplace(row, place.size());
    }
    for (diagnose::Column& column : table.columns) {
        keep(column.values, rows);
        keep(column.standard_errors, rows);
    }
    std::erase_if(table.left_out, [&](const diagnose::LeftOutCell& cell) { return !place.contains(cell.row); });
    for (diagnose::LeftOutCell& cell : table.left_out) {
        cell.row = place.at(cell.row);
    }
}

ColumnsToDrop drop_given_columns(diagnose::Measurement& table, const std::vector<std::string>& names) {
    ColumnsToDrop columns{names, {}};
    for (const std::string& name : names) {
        const bool there = name == "strain" ? diagnose::find_column(table, name) != nullptr : drop_column(table, name);
        if (!there) {
            columns.missing.push_back(name);
        }
    }
    return columns;
}

void drop_derived_columns(diagnose::Measurement& table, const ColumnsToDrop& columns) {
    for (const std::string& name : columns.names) {
        const bool derived = drop_column(table, name);
        if (!derived && std::find(columns.missing.begin(), columns.missing.end(), name) != columns.missing.end()) {
            throw InputError(table.label + ": there is no column '" + name + "' to do without");
        }
    }
}

}  // namespace coagula::experiment
