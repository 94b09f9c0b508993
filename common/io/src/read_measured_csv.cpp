// SPDX-License-Identifier: GPL-3.0-or-later
// CSV as spreadsheets and people write it: comma, semicolon or tab; lines that begin with # are comments. Blank lines part tables.
// A table is
//     <title, or lines "key, value">           may be missing
//     <labels of tables side by side>          may be missing
//     <headings, perhaps with units>           may be missing: then most cells of the first row are numbers
//     <units>                                  may be missing
//     <cells>
#include "measured_readers.hpp"

#include "side_by_side.hpp"
#include "text_reader.hpp"

#include <coagula/io/units.hpp>

#include <algorithm>
#include <iterator>
#include <optional>

namespace coagula::io {

namespace {

using Cells = std::vector<std::string>;

/// A line that is neither blank nor a comment.
struct FilledLine {
    std::size_t number;  ///< from 0
    bool after_blank;
    std::size_t fields;  ///< with empty ones at the end
    Cells cells;         ///< without
};

std::size_t filled(const Cells& cells) {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [](const std::string& cell) { return !cell.empty(); }));
}

bool has_number(const Cells& cells) {
    return std::any_of(cells.begin(), cells.end(), looks_like_number);
}

bool holds_numbers_only(const Cells& cells) {
    return has_number(cells) &&
           std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty() || looks_like_number(cell); });
}

/// Whether the cells are a row of numbers: at least half of them are numbers, and none is a heading. Texts such as a status may
/// stand in a row.
bool is_row(const Cells& cells) {
    const auto numbers = static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), looks_like_number));
    return numbers > 0 && 2 * numbers >= filled(cells) && std::none_of(cells.begin(), cells.end(), [](const std::string& cell) {
               return !quantity_of_heading(split_heading(cell).heading).empty();
           });
}

/// "49 <tab> KCl/Polymer 10degC <tab> 1" above rows of another width.
bool is_title(const Cells& cells, const FilledLine* next) {
    return filled(cells) > 0 && !holds_numbers_only(cells) && next != nullptr && next->cells.size() != cells.size() &&
           (filled(cells) == 1 || (has_number(cells) && holds_numbers_only(next->cells)));
}

bool are_units(const Cells& cells) {
    return filled(cells) > 0 && !has_number(cells) && std::all_of(cells.begin(), cells.end(), [](const std::string& cell) {
               return cell.empty() || (quantity_of_heading(cell).empty() && is_unit_text(normal_unit(cell)));
           });
}

bool is_skipped(const std::string& line) {
    return trim(line).empty() || trim(line).starts_with('#');
}

/// Tab, semicolon or comma: the first of these that stands in most lines, for a title may have a comma, too.
char separator_of(const MeasuredText& text) {
    for (const char separator : {'\t', ';', ','}) {
        std::size_t lines = 0;
        std::size_t with_it = 0;
        for (const std::string& line : text.lines) {
            lines += is_skipped(line) ? 0 : 1;
            with_it += !is_skipped(line) && line.find(separator) != std::string::npos ? 1 : 0;
        }
        if (with_it > 0 && 2 * with_it >= lines) {
            return separator;
        }
    }
    return ',';
}

/// Whether a line after a blank one is a title, or has the headings of a further table.
bool begins_table(const FilledLine& line, std::size_t width) {
    return line.after_blank && ((line.cells.size() != width && !holds_numbers_only(line.cells)) || !has_number(line.cells));
}

class CsvTables {
public:
    explicit CsvTables(const MeasuredText& text) : text_(text) { file_.path = text.path; }

    MeasuredFile run() {
        collect_lines();
        while (at_ < lines_.size()) {
            read_table();
        }
        return std::move(file_);
    }

private:
    void collect_lines();
    void read_table();
    void read_above(std::string& title);
    bool read_labels();
    void read_rows(const std::vector<HeadingWithUnit>& headings, bool given, const std::string& title);
    std::vector<HeadingWithUnit> read_headings(bool& given);
    const FilledLine* next() const { return at_ + 1 < lines_.size() ? &lines_[at_ + 1] : nullptr; }

    const MeasuredText& text_;
    MeasuredFile file_;
    MissingCells missing_;
    std::vector<FilledLine> lines_;
    std::size_t at_ = 0;
    Cells labels_;  ///< of tables side by side
};

void CsvTables::collect_lines() {
    const char separator = separator_of(text_);
    file_.decimal_comma = has_decimal_comma(text_, separator);
    bool after_blank = true;
    for (std::size_t number = 0; number < text_.lines.size(); ++number) {
        const std::string& line = text_.lines[number];
        Cells cells = is_skipped(line) ? Cells{} : split_cells(line, separator);
        if (is_blank(cells)) {
            after_blank = after_blank || !trim(line).starts_with('#');
            continue;
        }
        const std::size_t fields = cells.size();
        while (cells.back().empty()) {
            cells.pop_back();
        }
        lines_.push_back({number, after_blank, fields, std::move(cells)});
        after_blank = false;
    }
    if (lines_.empty()) {
        throw InputError(text_.path + " has no header");
    }
}

/// A line of as many labels as there are tables side by side below it.
bool CsvTables::read_labels() {
    const Cells& cells = lines_[at_].cells;
    if (filled(cells) < 2 || is_row(next()->cells)) {
        return false;
    }
    std::vector<HeadingWithUnit> headings;
    std::transform(next()->cells.begin(), next()->cells.end(), std::back_inserter(headings), split_heading);
    const auto layout = side_by_side(headings, true);
    if (!layout || layout->count != filled(cells)) {
        return false;
    }
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(labels_), [](const std::string& cell) { return !cell.empty(); });
    return true;
}

/// Titles and lines "key, value" above the headings.
void CsvTables::read_above(std::string& title) {
    labels_.clear();
    while (next() != nullptr) {
        if (read_labels()) {
            ++at_;
            return;
        }
        const Cells& cells = lines_[at_].cells;
        const bool key_and_value = cells.size() == 2 && next()->cells.size() > 2 && !has_number(cells);
        if (key_and_value) {
            file_.metadata.push_back({"", cells[0], cells[1]});
        } else if (is_title(cells, next())) {
            title.clear();
            for (const std::string& cell : cells) {
                title += looks_like_number(cell) || cell.empty() ? "" : (title.empty() ? "" : " ") + cell;
            }
        } else {
            return;
        }
        ++at_;
    }
}

/// Headings and units, or "column 1", ... where the first row is one of numbers.
std::vector<HeadingWithUnit> CsvTables::read_headings(bool& given) {
    const Cells& cells = lines_[at_].cells;
    std::vector<HeadingWithUnit> headings;
    given = !is_row(cells);
    if (!given) {
        std::size_t width = cells.size();
        for (std::size_t row = at_; row < lines_.size() && !begins_table(lines_[row], width); ++row) {
            width = std::max(width, lines_[row].cells.size());
        }
        for (std::size_t column = 1; column <= width; ++column) {
            headings.push_back({"column " + std::to_string(column), ""});
        }
        return headings;
    }
    const bool units_below = next() != nullptr && next()->cells.size() <= cells.size() && are_units(next()->cells);
    for (std::size_t column = 0; column < cells.size(); ++column) {
        headings.push_back(units_below ? HeadingWithUnit{cells[column], ""} : split_heading(cells[column]));
        if (units_below && column < next()->cells.size()) {
            headings.back().unit = normal_unit(next()->cells[column]);
        }
    }
    at_ += units_below ? 2 : 1;
    return headings;
}

void CsvTables::read_table() {
    std::string title;
    read_above(title);
    bool given = true;
    const std::vector<HeadingWithUnit> headings = read_headings(given);
    read_rows(headings, given, title);
}

/// One table, or several that stand side by side.
class TablesOfRows {
public:
    TablesOfRows(const std::vector<HeadingWithUnit>& headings, const std::optional<SideBySide>& layout, bool decimal_comma)
        : shared_(layout ? layout->shared : 0) {
        for (std::size_t table = 0; table < (layout ? layout->count : 1); ++table) {
            columns_.push_back(layout.value_or(SideBySide{0, headings.size(), 1}).columns_of(table));
            std::vector<HeadingWithUnit> own;
            for (const std::size_t column : columns_.back()) {
                own.push_back(column < headings.size() ? headings[column] : HeadingWithUnit{});
            }
            builders_.emplace_back(own, decimal_comma);
        }
    }

    /// A table of several goes without a row in which it has nothing.
    void add_row(const Cells& cells) {
        for (std::size_t table = 0; table < builders_.size(); ++table) {
            Cells own;
            for (const std::size_t column : columns_[table]) {
                own.push_back(column < cells.size() ? cells[column] : "");
            }
            if (builders_.size() == 1 || !is_blank({own.begin() + static_cast<std::ptrdiff_t>(shared_), own.end()})) {
                builders_[table].add_row(own);
            }
        }
    }

    std::vector<TableBuilder>& builders() { return builders_; }

private:
    std::size_t shared_;
    std::vector<std::vector<std::size_t>> columns_;
    std::vector<TableBuilder> builders_;
};

/// A temperature, or a bare number, tells results of one sample apart; a name that of a sample.
void add_label(PlainTable& table, const std::string& label) {
    auto temperature = temperature_of_label(label, table.rows());
    if (temperature || looks_like_number(label)) {
        table.title += (table.title.empty() ? "" : ", ") + label;
    } else {
        table.test = label;
    }
    if (temperature) {
        table.columns.push_back(std::move(*temperature));
    }
}

void CsvTables::read_rows(const std::vector<HeadingWithUnit>& headings, bool given, const std::string& title) {
    const auto layout = given ? side_by_side(headings, !labels_.empty()) : std::nullopt;
    TablesOfRows tables(headings, layout, file_.decimal_comma);
    const std::size_t first_row = at_;
    for (; at_ < lines_.size() && (at_ == first_row || !begins_table(lines_[at_], headings.size())); ++at_) {
        const FilledLine& line = lines_[at_];
        missing_.add(text_, line.number, headings.size(), line.cells.size());
        if (given && (line.fields < headings.size() || line.cells.size() > headings.size())) {
            text_.fail(line.number, "there are " + std::to_string(line.fields) + " fields, but the header names " +
                                        std::to_string(headings.size()));
        }
        tables.add_row(line.cells);
    }
    for (std::size_t table = 0; table < tables.builders().size(); ++table) {
        const bool several = table < labels_.size();
        PlainTable read = tables.builders()[table].take(title, static_cast<int>(file_.tables.size()) + 1, !given);
        if (several) {
            add_label(read, labels_[table]);
        }
        read.has_headings = given;
        read.first_line = first_row < lines_.size() ? text_.number(lines_[first_row].number) : 0;
        file_.tables.push_back(std::move(read));
    }
}

bool recognise(const MeasuredText& /*text*/) {
    return true;
}

MeasuredFile read(const MeasuredText& text) {
    return CsvTables(text).run();
}

}  // namespace

const MeasuredReader csv_reader{MeasuredFormat::csv, "CSV", recognise, read};

}  // namespace coagula::io
