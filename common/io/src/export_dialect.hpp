// SPDX-License-Identifier: GPL-3.0-or-later
// Text exports of rheometer programs. They differ in words and in where units stand; one reader reads them all by a table of that.
#pragma once

#include "measured_text.hpp"

#include <coagula/io/measured_file.hpp>

#include <span>
#include <string_view>
#include <utility>

namespace coagula::io {

/// What a line is, told by its first cell.
enum class LineRole {
    metadata,
    series,    ///< a new series of sections begins: test and title are those below
    test,      ///< its value is the name of the test
    title,     ///< its value is the name of result, series or step
    section,   ///< a section begins; its value, if any, is its number, a second value its number of points
    points,    ///< its value is the number of points of the section
    headings,  ///< the headings of a table follow in this line
};

enum class UnitsPlace {
    line_below,      ///< the line below the headings
    brackets_below,  ///< a line of units in brackets, at most two below the headings; such a line also tells what headings are
    after_heading,   ///< "omega / rad/s" or "omega in rad/s"
};

/// How a program writes its exports.
struct ExportDialect {
    MeasuredFormat format;
    std::span<const std::pair<std::string_view, LineRole>> words;  ///< first cells in lower case, without a colon at the end
    UnitsPlace units;
    std::span<const std::pair<std::string_view, std::string_view>> own_headings;  ///< lower case, and their usual names
};

/// Reads all tables of a text. Throws InputError naming file, line and rule.
MeasuredFile read_export(const MeasuredText& text, const ExportDialect& dialect);

/// The role of a line that has a word of the dialect in front; metadata for every other.
LineRole role_of(const ExportDialect& dialect, std::string_view first_cell);
/// The first cell of a line, in lower case and without a colon, whatever the separator.
std::string first_word(std::string_view line);

/// How many units in brackets a line holds, ",[s],[Pa]"; 0 when there is something else in it.
std::size_t units_in_brackets(const std::vector<std::string>& cells);

}  // namespace coagula::io
