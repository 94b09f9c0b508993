// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/input_file.hpp>
#include <coagula/io/measured_file.hpp>

#include "measured_readers.hpp"
#include "read_workbook.hpp"
#include "text_encoding.hpp"

#include <algorithm>
#include <array>

namespace coagula::io {

namespace {

/// The first that recognises a text reads it.
constexpr std::array readers = {&rheocompass_reader, &trios_reader,      &trios_json_reader, &rheowin_reader,
                                &rheoplus_reader,    &units_line_reader, &csv_reader};

/// Containers, by their first bytes, and what to do instead.
struct Container {
    std::string_view beginning;
    std::string_view name;
};
constexpr std::array containers = {
    Container{"<?xml", "XML"},
    Container{"\xef\xbb\xbf<?xml", "XML"},
    Container{"%PDF", "a PDF document"},
};

void refuse_containers(const std::string& path, const std::string& bytes) {
    for (const Container& container : containers) {
        if (bytes.starts_with(container.beginning)) {
            throw InputError(
                path + " is " + std::string(container.name) +
                ", which is not read: export the measurement as text or CSV from the program of the instrument, or save each "
                "sheet as CSV");
        }
    }
}

void number_tables(std::vector<PlainTable>& tables) {
    int number = 0;
    for (PlainTable& table : tables) {
        number += table.point == 0 ? 1 : 0;
        table.number = number;
    }
}

/// Tables that tell the time of day alone: the session began after the longest pause between them, so that what an earlier time
/// tells was measured on the day after.
void continue_after_midnight(std::vector<PlainTable>& tables) {
    constexpr double day = 86400;
    std::vector<double> times;
    for (const PlainTable& table : tables) {
        if (table.date < day) {
            times.push_back(table.date);
        }
    }
    std::sort(times.begin(), times.end());
    double longest = times.empty() ? 0 : times.front() + day - times.back();
    double first = times.empty() ? 0 : times.front();
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (times[i] - times[i - 1] > longest) {
            longest = times[i] - times[i - 1];
            first = times[i];
        }
    }
    for (PlainTable& table : tables) {
        table.date += table.date < first ? day : 0;
    }
}

MeasuredFile read_text(const std::string& path, const std::string& bytes) {
    const MeasuredText text = measured_text(path, to_utf8(bytes));
    if (std::any_of(text.lines.begin(), text.lines.end(),
                    [](const std::string& line) { return line.find('\0') != std::string::npos; })) {
        throw InputError(path + " is not a text file");
    }
    const auto* const reader =
        std::find_if(readers.begin(), readers.end(), [&](const auto* each) { return each->recognises(text); });
    return (*reader)->read(text);
}

}  // namespace

std::string_view name_of(MeasuredFormat format) {
    if (format == MeasuredFormat::workbook) {
        return "Excel workbook";
    }
    const auto* const found =
        std::find_if(readers.begin(), readers.end(), [&](const auto* reader) { return reader->format == format; });
    return found == readers.end() ? std::string_view{} : (*found)->name;
}

MeasuredFile read_measured_file(const std::string& path) {
    const std::string bytes = read_file(path);
    refuse_containers(path, bytes);
    MeasuredFile file = is_workbook(bytes) ? read_workbook(path) : read_text(path, bytes);
    number_tables(file.tables);
    continue_after_midnight(file.tables);
    return file;
}

void name_columns(PlainTable& table, const std::vector<std::string>& names) {
    if (names.size() != table.columns.size()) {
        throw InputError("there are " + std::to_string(table.columns.size()) + " columns, but 'columns' names " +
                         std::to_string(names.size()));
    }
    std::vector<PlainColumn> kept;
    std::vector<std::size_t> place(names.size());
    for (std::size_t column = 0; column < names.size(); ++column) {
        place[column] = kept.size();
        if (!names[column].empty()) {
            kept.push_back(plain_column(split_heading(names[column])));
            kept.back().values = std::move(table.columns[column].values);
        }
    }
    std::erase_if(table.unreadable, [&](const UnreadableCell& cell) { return names[cell.column].empty(); });
    for (UnreadableCell& cell : table.unreadable) {
        cell.column = place[cell.column];
    }
    table.columns = std::move(kept);
    table.has_headings = true;
}

}  // namespace coagula::io
