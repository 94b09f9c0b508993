// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_dialect.hpp"
#include "export_table.hpp"

#include "text_reader.hpp"

#include <coagula/io/date_time.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace coagula::io {

namespace {

constexpr std::size_t longest_title = 1000;  ///< every table of a result carries it, and every line of a group

/// Keys of the line that says when a measurement began, in TRIOS, RheoPlus (English and Japanese) and RheoWin.
constexpr std::array<std::string_view, 5> date_keys = {"run date", "measuring date/time", "測定日/時間", "date / time / version",
                                                       "date"};

std::string key_of(std::string_view cell) {
    cell = trim(cell);
    if (cell.ends_with(':')) {
        cell.remove_suffix(1);
    }
    return lower_case(trim(cell));
}

bool is_group(const std::vector<std::string>& cells) {
    const std::string& text = cells.front();
    const bool alone = std::all_of(cells.begin() + 1, cells.end(), [](const std::string& cell) { return cell.empty(); });
    return alone && text.size() > 2 && text.size() <= longest_title && text.front() == '[' && text.back() == ']';
}

/// The cells after the first that are not empty.
std::vector<std::string> values_of(const std::vector<std::string>& cells) {
    std::vector<std::string> values;
    std::copy_if(cells.begin() + 1, cells.end(), std::back_inserter(values), [](const std::string& cell) { return !cell.empty(); });
    return values;
}

/// Reads a file line by line.
class ExportReader {
public:
    ExportReader(const MeasuredText& text, const ExportDialect& dialect) : text_(text), dialect_(dialect) {
        file_.path = text.path;
        file_.format = dialect.format;
    }

    MeasuredFile run() {
        separator_ = find_separator();
        file_.decimal_comma = has_decimal_comma(text_, separator_);
        for (std::size_t line = 0; line < text_.lines.size();) {
            if (const auto head = table_head_at(text_, dialect_, separator_, line, in_section_)) {
                line = read_table(*head);
            } else {
                read_line(line++);
            }
        }
        if (step_without_headings_) {
            text_.fail(*step_without_headings_, "this step has no line of headings that names a known quantity");
        }
        if (file_.tables.empty()) {
            text_.fail(0, "a " + std::string(name_of(dialect_.format)) +
                              " export begins here, but no line of headings with units follows");
        }
        return std::move(file_);
    }

private:
    std::vector<std::string> cells_of(std::size_t line) const { return split_cells(text_.lines[line], separator_); }

    char find_separator() const;
    void read_line(std::size_t line);
    void begin_section(std::size_t line, const std::vector<std::string>& values);
    void add_metadata(const std::string& key, const std::string& value);
    std::size_t read_table(const TableHead& head);
    bool ends_table(const std::vector<std::string>& row, const TableHead& head) const;
    std::vector<std::string> aligned(std::size_t line, const TableHead& head) const;
    static bool begins_point(const std::vector<std::string>& row, const TableHead& head);
    void check_row(std::size_t line, const TableHead& head, const std::vector<std::string>& cells) const;
    double start_of(double by_clock);
    void keep(TableRows& rows, std::size_t first_line);

    const MeasuredText& text_;
    const ExportDialect& dialect_;
    char separator_ = '\t';
    MissingCells missing_;
    MeasuredFile file_;
    std::string group_;
    std::string test_;
    std::string title_;
    int section_ = 1;
    int announced_ = 0;
    double date_ = unset;                               ///< of the next table
    double last_date_ = unset;                          ///< that the file has named so far
    bool in_section_ = false;                           ///< a section has begun whose headings are still to come
    std::optional<std::size_t> step_without_headings_;  ///< line
};

/// Tab, semicolon or comma: the first of these that occurs where the headings can be.
char ExportReader::find_separator() const {
    for (const char separator : {'\t', ';', ','}) {
        for (const std::string& line : text_.lines) {
            const std::vector<std::string> cells = split_cells(line, separator);
            if (cells.size() > 1 && (role_of(dialect_, cells.front()) == LineRole::headings || units_in_brackets(cells) > 1)) {
                return separator;
            }
            const bool known = std::any_of(cells.begin(), cells.end(), [](const std::string& cell) {
                return !quantity_of_heading(cell).empty() || !quantity_of_heading(split_heading(cell).heading).empty();
            });
            if (cells.size() > 2 && known) {
                return separator;
            }
        }
    }
    return '\t';
}

void ExportReader::begin_section(std::size_t line, const std::vector<std::string>& values) {
    if (step_without_headings_) {
        text_.fail(*step_without_headings_, "this step has no line of headings that names a known quantity");
    }
    const int number = values.empty() ? 0 : announced_count(values[0]);
    section_ = number > 0 ? number : section_ + (file_.tables.empty() ? 0 : 1);
    announced_ = values.size() > 1 ? announced_count(values[1]) : 0;
    in_section_ = true;
    if (dialect_.units == UnitsPlace::line_below) {
        title_.clear();
        step_without_headings_ = line;
    }
}

void ExportReader::read_line(std::size_t line) {
    const std::vector<std::string> cells = cells_of(line);
    const std::vector<std::string> values = values_of(cells);
    const LineRole role = role_of(dialect_, cells.front());
    if (role == LineRole::section) {
        begin_section(line, values);
    } else if (role == LineRole::series) {
        test_.clear();
        title_.clear();
    } else if (role == LineRole::points) {
        announced_ = values.empty() ? 0 : announced_count(values[0]);
    } else if (role == LineRole::test || role == LineRole::title) {
        std::string& name = role == LineRole::test ? test_ : title_;
        name = joined(values);
        if (name.size() > longest_title) {
            text_.fail(line, "the name of the result has " + std::to_string(name.size()) + " characters, but must have at most " +
                                 std::to_string(longest_title));
        }
    } else if (is_group(cells)) {
        group_ = cells.front().substr(1, cells.front().size() - 2);
    } else if (in_section_ && dialect_.units == UnitsPlace::line_below && title_.empty() && values.empty()) {
        title_ = cells.front();
    } else if (!cells.front().empty() && !values.empty()) {
        const std::string& key = cells.front();
        add_metadata(key.ends_with(':') ? key.substr(0, key.size() - 1) : key, joined(values));
    } else if (const std::size_t colon = cells.front().find(": "); colon != std::string::npos) {
        add_metadata(cells.front().substr(0, colon), cells.front().substr(colon + 2));
    }
}

void ExportReader::add_metadata(const std::string& key, const std::string& value) {
    file_.metadata.push_back({group_, key, value});
    if (std::find(date_keys.begin(), date_keys.end(), lower_case(key)) != date_keys.end()) {
        date_ = seconds_of_date(value).value_or(date_);
        last_date_ = std::isnan(date_) ? last_date_ : date_;
    }
}

bool ExportReader::ends_table(const std::vector<std::string>& row, const TableHead& head) const {
    if (is_blank(row) || is_group(row) || role_of(dialect_, row.front()) != LineRole::metadata) {
        return true;
    }
    const std::string& label = row.front();
    if (dialect_.units == UnitsPlace::after_heading) {
        return label.find('|') == std::string::npos;
    }
    const bool numbered = head.labels == 1 && dialect_.units == UnitsPlace::brackets_below;
    return numbered ? !label.empty() && std::isdigit(static_cast<unsigned char>(label.front())) == 0
                    : head.labels >= 2 && !label.empty();
}

bool begins_with_digit(const std::string& text) {
    const std::size_t at = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// A row whose empty first cell was lost, as where blanks at the beginnings of lines are trimmed, gets it back. Where more is
/// missing, nobody can say which cells.
std::vector<std::string> ExportReader::aligned(std::size_t line, const TableHead& head) const {
    std::vector<std::string> row = cells_of(line);
    if (!head.margin || !begins_with_digit(row.front())) {
        return row;
    }
    if (row.size() + 1 < head.labels + head.named()) {
        text_.fail(line, "there are " + std::to_string(row.size()) + " cells, but the headings name " +
                             std::to_string(head.labels + head.named()) +
                             ", and the first cell, which is empty in such exports, is not: cells at the beginnings of lines were "
                             "lost; export the measurement again");
    }
    row.insert(row.begin(), "");
    return row;
}

/// Whether a row is a point of its own, not a further sample of the waveform of the last one.
bool ExportReader::begins_point(const std::vector<std::string>& row, const TableHead& head) {
    if (head.labels > (head.margin ? 1 : 0)) {
        return head.labels <= row.size() && !row[head.labels - 1].empty();
    }
    bool all_points = true;
    for (std::size_t column = 0; column < head.waveform.size(); ++column) {
        const std::size_t cell = head.labels + column;
        if (!head.waveform[column] && cell < row.size() && !row[cell].empty()) {
            return true;
        }
        all_points = all_points && !head.waveform[column];
    }
    return all_points;
}

/// A separator within numbers, such as that of thousands, moves the cells behind it away from their headings.
void ExportReader::check_row(std::size_t line, const TableHead& head, const std::vector<std::string>& cells) const {
    const std::size_t named = head.named();
    for (std::size_t column = named; column < cells.size(); ++column) {
        if (!cells[column].empty()) {
            text_.fail(line, "there are " + std::to_string(head.labels + column + 1) + " cells, but the headings name " +
                                 std::to_string(head.labels + named) +
                                 ": a separator within numbers has split them; export with tabs, or without thousands separators");
        }
    }
}

/// The clock of the rows tells more than the head of the file, which may lack nothing but the day, or name the start of a
/// procedure.
double ExportReader::start_of(double by_clock) {
    constexpr double day = 86400;
    const double by_head = std::exchange(date_, unset);
    if (std::isnan(by_clock) || by_clock >= day || std::isnan(last_date_)) {
        return std::isnan(by_clock) ? by_head : by_clock;
    }
    const double start = day * std::floor(last_date_ / day) + by_clock;
    return start + 60 < last_date_ ? start + day : start;
}

void ExportReader::keep(TableRows& rows, std::size_t first_line) {
    for (PlainTable& table : rows.take()) {
        table.test = test_;
        table.title = title_;
        table.section = section_;
        table.announced_points = table.point == 0 ? announced_ : 0;
        table.first_line = text_.number(first_line);
        table.date = start_of(table.date);
        file_.tables.push_back(std::move(table));
    }
}

/// Returns the line after the last one of the table.
std::size_t ExportReader::read_table(const TableHead& head) {
    if (!in_section_ && !file_.tables.empty()) {
        ++section_;  // a table that nothing announces
    }
    std::optional<TableRows> rows(std::in_place, head, file_.decimal_comma);
    std::size_t first_line = head.first_row;
    std::string series;  // of RheoWin: what stands before the bar in "2|17"
    std::size_t line = head.first_row;
    for (; line < text_.lines.size(); ++line) {
        const std::vector<std::string> row = aligned(line, head);
        if (ends_table(row, head)) {
            break;
        }
        if (dialect_.units == UnitsPlace::after_heading) {
            const std::string label = row.front().substr(0, row.front().find('|'));
            if (rows->points() > 0 && label != series) {
                keep(*rows, first_line);
                rows.emplace(head, file_.decimal_comma);
                first_line = line;
            }
            series = label;
            section_ = std::max(1, announced_count(series));
        }
        const std::vector<std::string> cells = behind(row, head.labels);
        missing_.add(text_, line, head.headings.size(), cells.size());
        check_row(line, head, cells);
        const bool new_point = begins_point(row, head);
        if (!new_point && rows->points() == 0) {
            text_.fail(line, "the first line of an interval has no number of a point");
        }
        rows->add(cells, new_point);
    }
    keep(*rows, first_line);
    announced_ = 0;
    in_section_ = false;
    step_without_headings_.reset();
    return line;
}

}  // namespace

LineRole role_of(const ExportDialect& dialect, std::string_view first_cell) {
    const std::string key = key_of(first_cell);
    const auto found =
        std::find_if(dialect.words.begin(), dialect.words.end(), [&](const auto& word) { return word.first == key; });
    return found == dialect.words.end() ? LineRole::metadata : found->second;
}

std::string first_word(std::string_view line) {
    return key_of(line.substr(0, line.find_first_of("\t;,")));
}

std::size_t units_in_brackets(const std::vector<std::string>& cells) {
    const auto in_brackets = [](const std::string& cell) { return cell.size() >= 2 && cell.front() == '[' && cell.back() == ']'; };
    const bool alone = std::all_of(cells.begin(), cells.end(), [&](const auto& cell) { return cell.empty() || in_brackets(cell); });
    return alone ? static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), in_brackets)) : 0;
}

MeasuredFile read_export(const MeasuredText& text, const ExportDialect& dialect) {
    return ExportReader(text, dialect).run();
}

}  // namespace coagula::io
