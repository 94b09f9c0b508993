// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of measured tables share: lines in UTF-8, fields, tables that grow row by row.
#pragma once

#include "cell_number.hpp"
#include "rheometer_headings.hpp"

#include <coagula/io/measured_file.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::io {

/// Lines without their ends.
std::vector<std::string> split_lines(const std::string& text);

/// Fields of a line without blanks and quotes around them. Separators within quotes do not split; quotes that do not begin a field,
/// as in G" [Pa], are part of it.
std::vector<std::string> split_cells(std::string_view line, char separator);

/// Tab, semicolon or comma: the first of these that the line contains.
char separator_in(std::string_view line);

/// Whether all cells are empty.
bool is_blank(const std::vector<std::string>& cells);

/// A count that a file announces; 0 when the text is no whole number above zero.
int announced_count(std::string_view text);

/// A column without values: what its heading means, of which the unit may decide ("Frequency [rad/s]" is an angular frequency).
PlainColumn plain_column(HeadingWithUnit heading);

/// A table that grows row by row.
class TableBuilder {
public:
    TableBuilder(const std::vector<HeadingWithUnit>& headings, bool decimal_comma);

    /// One row; missing fields are empty cells.
    void add_row(const std::vector<std::string>& cells);
    /// Takes what stands for no value out, gives the rows the times of their clock where they have no others, and, unless all are
    /// to be kept, drops the columns that carry no number and have no known heading.
    PlainTable take(std::string title, int section, bool keep_all = false);
    std::size_t rows() const { return rows_; }

private:
    void add_flags(const std::string& status);
    void note_clock(const std::string& date_and_time);
    std::vector<double> unbroken_clock() const;
    double start_by_clock() const;
    void add_times_by_clock();
    void take_out_loss_tangent_limit();
    void take_out_negative_moduli();
    void take_out(std::size_t column, std::size_t row, const std::string& reason);
    std::size_t column_of(std::string_view quantity) const;

    PlainTable table_;
    std::vector<bool> is_status_;               ///< per column
    std::vector<bool> is_clock_;                ///< per column: tells the time of day
    std::vector<double> clock_;                 ///< per row: what it tells, as seconds_of_date() or seconds_of_day() [s], or NaN
    std::vector<bool> has_number_;              ///< per column
    std::vector<std::size_t> negative_moduli_;  ///< rows flagged so
    std::map<std::string, std::size_t> flags_;
    bool decimal_comma_;
    std::size_t rows_ = 0;
};

/// A file in memory.
struct MeasuredText {
    std::string path;
    std::vector<std::string> lines;
    std::size_t spacing = 1;  ///< 2 where a blank line, which is not among `lines`, followed each of them

    /// Number of a line in the file, from 1; `line` counts from 0.
    std::size_t number(std::size_t line) const { return line * spacing + 1; }
    /// Throws InputError "FILE, line N: rule"; `line` counts from 0.
    [[noreturn]] void fail(std::size_t line, const std::string& rule) const;
};

/// The lines of a text in UTF-8. Where every other line is blank, as where line ends were converted twice, these are left out.
MeasuredText measured_text(const std::string& path, const std::string& text);

/// Counts the cells that the rows of a file lack: short rows under long headings would fill the memory with empty cells.
class MissingCells {
public:
    /// Throws InputError when a file lacks too many. `line` counts from 0.
    void add(const MeasuredText& text, std::size_t line, std::size_t headings, std::size_t cells);

private:
    std::size_t missing_ = 0;
};

/// Whether numbers of the file have decimal commas. All cells of lines with more than one cell have a vote.
bool has_decimal_comma(const MeasuredText& text, char separator);

}  // namespace coagula::io
