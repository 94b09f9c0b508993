// What the readers of measured tables share: lines in UTF-8, fields, cells with a decimal comma or point.
#pragma once

#include <coagula/io/measured_file.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::io {

/// The contents in UTF-8: from UTF-16 where a byte order mark says so, from Windows-1252 where it is not valid UTF-8.
std::string to_utf8(std::string_view bytes);

/// Lines without their ends.
std::vector<std::string> split_lines(const std::string& text);

/// Fields of a line without blanks and quotes around them; separators within quotes do not split.
std::vector<std::string> split_cells(std::string_view line, char separator);

/// Tab, semicolon or comma: the first of these that the line contains.
char separator_in(std::string_view line);

/// Whether the cells of a file have a decimal comma: by majority among the numbers that can be read in one way only.
class DecimalCommaVote {
public:
    void add(std::string_view cell);
    bool comma_wins() const { return commas_ > points_; }

private:
    std::size_t commas_ = 0;
    std::size_t points_ = 0;
};

struct CellNumber {
    std::optional<double> value;
    std::string complaint;  ///< why it cannot be read; empty for a number and for an empty cell
};
CellNumber read_cell(std::string_view text, bool decimal_comma);

/// Heading and unit of "strain [%]" or "strain (%)"; the unit is empty when there is none.
struct HeadingWithUnit {
    std::string heading;
    std::string unit;
};
HeadingWithUnit split_heading(std::string_view text);

/// A table that grows row by row.
class TableBuilder {
public:
    TableBuilder(std::vector<HeadingWithUnit> headings, bool decimal_comma);

    /// One row; missing fields are empty cells.
    void add_row(const std::vector<std::string>& cells);
    /// Drops the columns that carry no number and have no known heading.
    PlainTable take(std::string title, int section);
    std::size_t rows() const { return rows_; }

private:
    PlainTable table_;
    bool decimal_comma_;
    std::size_t rows_ = 0;
};

/// A file in memory.
struct MeasuredText {
    std::string path;
    std::vector<std::string> lines;

    /// Throws InputError "FILE, line N: rule"; `line` counts from 0.
    [[noreturn]] void fail(std::size_t line, const std::string& rule) const;
};

/// Counts the cells that the rows of a file lack: short rows under long headings would fill the memory with empty cells.
class MissingCells {
public:
    /// Throws InputError when a file lacks too many. `line` counts from 0.
    void add(const MeasuredText& text, std::size_t line, std::size_t headings, std::size_t cells);

private:
    std::size_t missing_ = 0;
};

bool looks_like_rheocompass(const MeasuredText& text);
bool looks_like_trios(const MeasuredText& text);
MeasuredFile read_rheocompass(const MeasuredText& text);
MeasuredFile read_trios(const MeasuredText& text);
MeasuredFile read_measured_csv(const MeasuredText& text);

}  // namespace coagula::io
