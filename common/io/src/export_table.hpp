// SPDX-License-Identifier: GPL-3.0-or-later
// One table of a text export: where its headings and units stand, and its rows.
#pragma once

#include "export_dialect.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace coagula::io {

/// The headings of a table and where its rows begin.
struct TableHead {
    std::vector<HeadingWithUnit> headings;  ///< without the labels
    std::vector<bool> waveform;             ///< which columns hold samples of the waveform of a point
    std::size_t labels = 0;                 ///< cells before the first column; the last of them numbers the point
    std::size_t first_row = 0;              ///< line
    bool margin = false;                    ///< the first label is a word beside the headings, below which cells are empty

    /// Columns up to the last one with a heading.
    std::size_t named() const;
};

/// The head of the table that begins in this line, if one does. `in_section`: a section has begun whose headings are still to come.
/// Throws InputError when headings are announced, but no units follow.
std::optional<TableHead> table_head_at(const MeasuredText& text, const ExportDialect& dialect, char separator, std::size_t line,
                                       bool in_section);

/// The cells that stand behind the labels of a row.
std::vector<std::string> behind(const std::vector<std::string>& cells, std::size_t labels);

/// Words with a blank between them.
std::string joined(const std::vector<std::string>& words);

/// The rows of one table: its points, and the waveforms of those that come with one.
class TableRows {
public:
    /// @param head must live as long.
    TableRows(const TableHead& head, bool decimal_comma);

    /// A row without the labels; `new_point` unless it goes on with the waveform of the last point.
    void add(const std::vector<std::string>& cells, bool new_point);
    std::size_t points() const { return points_.rows(); }
    /// The points first, then the waveforms.
    std::vector<PlainTable> take();

private:
    void finish_waveform();

    const TableHead* head_;
    bool decimal_comma_;
    TableBuilder points_;
    std::optional<TableBuilder> waveform_;
    std::vector<PlainTable> waveforms_;
};

}  // namespace coagula::io
