// CSV export of Anton Paar RheoCompass. Lines "Project:", "Test:", "Result:" and then, per interval,
//     Interval and data points:  <interval>  <points>
//     Interval data:  Point No.  <headings>
//                                <what distinguishes equal headings, such as Waveform; the line may be missing>
//                                <units in brackets>
//                     1          <cells>
// A point with a waveform is followed by lines without a number that carry the further samples of the waveform columns. There is no
// public specification: this is what English and German files show.
#include "measured_text.hpp"

#include "text_reader.hpp"

#include <algorithm>

namespace coagula::io {

namespace {

bool begins_with_any(std::string_view line, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(), [&](std::string_view text) { return line.starts_with(text); });
}

bool announces_interval(const std::string& line) {
    return begins_with_any(line, {"Interval and data points:", "Abschnitt und Datenpunkte:"});
}

bool begins_table(const std::string& line) {
    return begins_with_any(line, {"Interval data:", "Abschnittsdaten:"});
}

bool is_waveform(const std::string& qualifier) {
    return qualifier == "Waveform" || qualifier == "Wellenform";
}

bool is_blank(const std::vector<std::string>& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
}

/// Headings of an interval; `waveform` says which columns hold samples of the waveform.
struct IntervalHead {
    std::vector<HeadingWithUnit> headings;  ///< without the first two columns
    std::vector<bool> waveform;
    std::size_t first_row;  ///< line of the first point
};

std::vector<std::string> cells_of(const std::string& line, char separator) {
    std::vector<std::string> cells = split_cells(line, separator);
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, cells.size())));
    return cells;
}

bool holds_units(const std::vector<std::string>& cells) {
    return std::any_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.starts_with('['); });
}

IntervalHead read_head(const MeasuredText& text, std::size_t line, char separator) {
    IntervalHead head;
    for (std::string& heading : cells_of(text.lines[line], separator)) {
        head.headings.push_back({std::move(heading), ""});
    }
    head.waveform.assign(head.headings.size(), false);
    for (std::size_t next = line + 1; next < text.lines.size() && next <= line + 2; ++next) {
        const std::vector<std::string> cells = cells_of(text.lines[next], separator);
        const bool units = holds_units(cells);
        for (std::size_t column = 0; column < std::min(cells.size(), head.headings.size()); ++column) {
            if (units && cells[column].size() >= 2) {
                head.headings[column].unit = cells[column].substr(1, cells[column].size() - 2);
            } else if (is_waveform(cells[column])) {
                head.waveform[column] = true;
            }
        }
        if (units) {
            head.first_row = next + 1;
            return head;
        }
    }
    text.fail(line, "no line with units in brackets follows the headings of this interval");
}

constexpr std::size_t longest_title = 1000;  ///< every table of a result carries it

/// The cells of the columns for which `waveform` is `wanted`.
template <class Item>
std::vector<Item> select(const std::vector<Item>& items, const std::vector<bool>& waveform, bool wanted) {
    std::vector<Item> selected;
    for (std::size_t i = 0; i < std::min(items.size(), waveform.size()); ++i) {
        if (waveform[i] == wanted) {
            selected.push_back(items[i]);
        }
    }
    return selected;
}

/// Reads the tables of one interval, the points first, then the waveforms.
class IntervalReader {
public:
    IntervalReader(const MeasuredText& text, IntervalHead head, char separator, bool decimal_comma, MissingCells& missing)
        : text_(text),
          missing_(missing),
          head_(std::move(head)),
          separator_(separator),
          decimal_comma_(decimal_comma),
          points_(select(head_.headings, head_.waveform, false), decimal_comma) {}

    /// Returns the line after the last one of the interval.
    std::size_t read() {
        std::size_t line = head_.first_row;
        for (; line < text_.lines.size(); ++line) {
            const std::vector<std::string> row = split_cells(text_.lines[line], separator_);
            if (is_blank(row) || !row.front().empty()) {
                break;
            }
            add(row, line);
        }
        finish_waveform();
        return line;
    }

    void move_tables(std::vector<PlainTable>& tables, const std::string& title, int section, int announced) {
        PlainTable points = points_.take(title, section);
        points.announced_points = announced;
        tables.push_back(std::move(points));
        for (PlainTable& waveform : waveforms_) {
            waveform.title = title;
            waveform.section = section;
            tables.push_back(std::move(waveform));
        }
    }

private:
    void add(const std::vector<std::string>& row, std::size_t line) {
        const std::vector<std::string> cells(row.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, row.size())),
                                             row.end());
        missing_.add(text_, line, head_.headings.size(), cells.size());
        const bool new_point = row.size() > 1 && !row[1].empty();
        if (!new_point && points_.rows() == 0) {
            text_.fail(line, "the first line of an interval has no number of a point");
        }
        if (new_point) {
            finish_waveform();
            points_.add_row(select(cells, head_.waveform, false));
            waveform_.emplace(select(head_.headings, head_.waveform, true), decimal_comma_);
        }
        waveform_->add_row(select(cells, head_.waveform, true));
    }

    void finish_waveform() {
        if (waveform_ && waveform_->rows() > 1) {
            PlainTable table = waveform_->take("", 1);
            table.point = static_cast<int>(points_.rows());
            waveforms_.push_back(std::move(table));
        }
        waveform_.reset();
    }

    const MeasuredText& text_;
    MissingCells& missing_;
    IntervalHead head_;
    char separator_;
    bool decimal_comma_;
    TableBuilder points_;
    std::optional<TableBuilder> waveform_;
    std::vector<PlainTable> waveforms_;
};

bool find_decimal_comma(const MeasuredText& text, char separator) {
    DecimalCommaVote vote;
    for (const std::string& line : text.lines) {
        if (separator != ',' && !line.empty() && line.front() == separator) {
            for (const std::string& cell : split_cells(line, separator)) {
                vote.add(cell);
            }
        }
    }
    return vote.comma_wins();
}

/// Section number and number of points of the announcing line; zero where it says none.
std::pair<int, int> announced(const std::string& line, char separator) {
    const std::vector<std::string> cells = split_cells(line, separator);
    const auto number = [&](std::size_t i) {
        const CellNumber cell = i < cells.size() ? read_cell(cells[i], false) : CellNumber{};
        return cell.value && *cell.value > 0 && *cell.value < 1e9 ? static_cast<int>(*cell.value) : 0;
    };
    return {number(1), number(2)};
}

}  // namespace

bool looks_like_rheocompass(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(), announces_interval);
}

MeasuredFile read_rheocompass(const MeasuredText& text) {
    MeasuredFile file{text.path, MeasuredFormat::rheocompass, false, {}, {}};
    const auto first_table = std::find_if(text.lines.begin(), text.lines.end(), begins_table);
    if (first_table == text.lines.end()) {
        text.fail(0, "an interval is announced, but no line begins with 'Interval data:' or 'Abschnittsdaten:'");
    }
    const char separator = separator_in(*first_table);
    file.decimal_comma = find_decimal_comma(text, separator);
    MissingCells missing;
    std::string title;
    std::pair<int, int> section_and_points{1, 0};
    for (std::size_t line = 0; line < text.lines.size();) {
        const std::string& content = text.lines[line];
        if (begins_table(content)) {
            IntervalReader interval(text, read_head(text, line, separator), separator, file.decimal_comma, missing);
            line = interval.read();
            interval.move_tables(file.tables, title, section_and_points.first, section_and_points.second);
            continue;
        }
        const std::vector<std::string> cells = split_cells(content, separator);
        if (announces_interval(content)) {
            section_and_points = announced(content, separator);
        } else if (cells.size() > 1 && cells[0].ends_with(':')) {
            file.metadata.emplace_back(cells[0].substr(0, cells[0].size() - 1), cells[1]);
            title = begins_with_any(cells[0], {"Result:", "Ergebnis:"}) ? cells[1] : title;
            if (title.size() > longest_title) {
                text.fail(line, "the name of the result has " + std::to_string(title.size()) +
                                    " characters, but must have at most " + std::to_string(longest_title));
            }
        }
        ++line;
    }
    return file;
}

}  // namespace coagula::io
