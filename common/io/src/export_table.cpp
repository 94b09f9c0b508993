// SPDX-License-Identifier: GPL-3.0-or-later
#include "export_table.hpp"

#include "text_reader.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace coagula::io {

namespace {

std::size_t filled(const std::vector<std::string>& cells) {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [](const std::string& cell) { return !cell.empty(); }));
}

constexpr std::array<std::string_view, 3> unit_marks = {" / ", " in ", " en "};  // between heading and unit

bool is_waveform(const std::string& qualifier) {
    return qualifier == "Waveform" || qualifier == "Wellenform" || qualifier == "Forme d'onde";
}

/// The items of the columns for which `waveform` is `wanted`.
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

/// Looks for the head of a table at one line.
class HeadFinder {
public:
    HeadFinder(const MeasuredText& text, const ExportDialect& dialect, char separator, std::size_t line)
        : text_(text), dialect_(dialect), separator_(separator), line_(line), cells_(cells_of(line)) {}

    std::optional<TableHead> with_line_below(bool in_section) const;
    std::optional<TableHead> with_brackets_below() const;
    std::optional<TableHead> with_units_inside() const;

private:
    std::vector<std::string> cells_of(std::size_t line) const { return split_cells(text_.lines[line], separator_); }

    HeadingWithUnit heading(const std::string& name, const std::string& unit) const {
        const std::string key = lower_case(name);
        const auto own = std::find_if(dialect_.own_headings.begin(), dialect_.own_headings.end(),
                                      [&](const auto& entry) { return entry.first == key; });
        return {own == dialect_.own_headings.end() ? name : std::string(own->second), normal_unit(unit)};
    }

    /// The names of a line and the units of another.
    TableHead head_of(const std::vector<std::string>& units, std::size_t labels, std::size_t first_row) const {
        TableHead head{{}, {}, labels, first_row};
        for (std::size_t column = labels; column < cells_.size(); ++column) {
            head.headings.push_back(heading(cells_[column], column < units.size() ? units[column] : ""));
        }
        head.waveform.assign(head.headings.size(), false);
        return head;
    }

    const MeasuredText& text_;
    const ExportDialect& dialect_;
    char separator_;
    std::size_t line_;
    std::vector<std::string> cells_;
};

/// TRIOS: within a step, the line of "Variables", or the first that names a known quantity and holds no number.
std::optional<TableHead> HeadFinder::with_line_below(bool in_section) const {
    const LineRole role = role_of(dialect_, cells_.front());
    const bool may_be_unmarked = in_section && role == LineRole::metadata && cells_.size() > 1;
    const bool unmarked =
        may_be_unmarked && std::none_of(cells_.begin(), cells_.end(), looks_like_number) &&
        std::any_of(cells_.begin(), cells_.end(), [](const std::string& cell) { return !quantity_of_heading(cell).empty(); });
    if (!in_section || !(role == LineRole::headings || unmarked)) {
        return std::nullopt;
    }
    if (line_ + 1 >= text_.lines.size()) {
        text_.fail(line_, "the file ends after the headings");
    }
    return head_of(cells_of(line_ + 1), role == LineRole::headings ? 1 : 0, line_ + 2);
}

/// RheoCompass and RheoPlus: a line below which, perhaps after one that distinguishes equal headings (Waveform), the units stand.
std::optional<TableHead> HeadFinder::with_brackets_below() const {
    const LineRole role = role_of(dialect_, cells_.front());
    const bool marked = role == LineRole::headings;
    const std::size_t fewest = marked ? 1 : 2;
    if (cells_.size() < 2 || (!marked && role != LineRole::metadata) || units_in_brackets(cells_) > 0) {
        return std::nullopt;
    }
    std::vector<std::string> qualifiers;
    for (std::size_t next = line_ + 1; next < std::min(text_.lines.size(), line_ + 3); ++next) {
        const std::vector<std::string> units = cells_of(next);
        if (units_in_brackets(units) < fewest) {
            qualifiers = units;
            continue;
        }
        if (!marked && filled(cells_) < filled(units)) {
            return std::nullopt;
        }
        const auto first_unit = std::find_if(units.begin(), units.end(), [](const std::string& unit) { return !unit.empty(); });
        const auto labels = static_cast<std::size_t>(first_unit - units.begin());
        TableHead head = head_of(units, labels, next + 1);
        head.margin = labels > 0 && cells_.front().ends_with(':');
        for (std::size_t column = 0; column < head.waveform.size() && labels + column < qualifiers.size(); ++column) {
            head.waveform[column] = is_waveform(qualifiers[labels + column]);
        }
        return head;
    }
    if (marked) {
        text_.fail(line_, "no line with units in brackets follows the headings of this interval");
    }
    return std::nullopt;
}

/// RheoWin: ";omega / rad/s;G' / Pa;", ";omega in rad/s;" or "Nr-Seg;omega en rad/s;".
std::optional<TableHead> HeadFinder::with_units_inside() const {
    if (cells_.size() < 3 || is_blank(behind(cells_, 1))) {
        return std::nullopt;
    }
    TableHead head{{}, {}, 1, line_ + 1};
    for (const std::string& cell : behind(cells_, 1)) {
        const auto* const mark = std::find_if(unit_marks.begin(), unit_marks.end(),
                                              [&](std::string_view each) { return cell.find(each) != std::string::npos; });
        if (mark == unit_marks.end() && !cell.empty()) {
            return std::nullopt;
        }
        const std::size_t at = cell.empty() ? 0 : cell.find(*mark);
        head.headings.push_back(cell.empty() ? HeadingWithUnit{} : heading(cell.substr(0, at), cell.substr(at + mark->size())));
    }
    head.waveform.assign(head.headings.size(), false);
    return head;
}

}  // namespace

std::size_t TableHead::named() const {
    const auto last = std::find_if(headings.rbegin(), headings.rend(), [](const auto& one) { return !one.heading.empty(); });
    return static_cast<std::size_t>(headings.rend() - last);
}

std::optional<TableHead> table_head_at(const MeasuredText& text, const ExportDialect& dialect, char separator, std::size_t line,
                                       bool in_section) {
    const HeadFinder finder(text, dialect, separator, line);
    switch (dialect.units) {
        case UnitsPlace::line_below:
            return finder.with_line_below(in_section);
        case UnitsPlace::brackets_below:
            return finder.with_brackets_below();
        case UnitsPlace::after_heading:
            return finder.with_units_inside();
    }
    return std::nullopt;
}

std::vector<std::string> behind(const std::vector<std::string>& cells, std::size_t labels) {
    return {cells.begin() + static_cast<std::ptrdiff_t>(std::min(labels, cells.size())), cells.end()};
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : " ") + word;
    }
    return text;
}

TableRows::TableRows(const TableHead& head, bool decimal_comma)
    : head_(&head), decimal_comma_(decimal_comma), points_(select(head.headings, head.waveform, false), decimal_comma) {}

void TableRows::add(const std::vector<std::string>& cells, bool new_point) {
    if (new_point) {
        finish_waveform();
        points_.add_row(select(cells, head_->waveform, false));
        waveform_.emplace(select(head_->headings, head_->waveform, true), decimal_comma_);
    }
    waveform_->add_row(select(cells, head_->waveform, true));
}

void TableRows::finish_waveform() {
    if (waveform_ && waveform_->rows() > 1) {
        waveforms_.push_back(waveform_->take("", 1));
        waveforms_.back().point = static_cast<int>(points_.rows());
    }
    waveform_.reset();
}

std::vector<PlainTable> TableRows::take() {
    finish_waveform();
    std::vector<PlainTable> tables{points_.take("", 1)};
    std::move(waveforms_.begin(), waveforms_.end(), std::back_inserter(tables));
    return tables;
}

}  // namespace coagula::io
