// SPDX-License-Identifier: GPL-3.0-or-later
#include "measured_text.hpp"

#include "text_reader.hpp"

#include <coagula/io/date_time.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace coagula::io {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// RheoCompass and RheoPlus write this loss tangent where they have none, and moduli that follow from it.
constexpr double loss_tangent_limit = 20000;

constexpr std::array status_headings = {"status", "statut", "etat", "état", "ステータス"};

constexpr std::array clock_headings = {"time of day",   "date time", "datetime",  "date/time",  "date and time", "timestamp",
                                       "clock time",    "uhrzeit",   "tageszeit", "heure",      "date",          "datum",
                                       "absolute time", "abs. time", "abs time",  "local time", "time stamp"};

constexpr double day = 86400;  // s

template <std::size_t size>
bool is_one_of(const std::array<const char*, size>& names, const std::string& heading) {
    return std::find(names.begin(), names.end(), lower_case(heading)) != names.end();
}

/// Flags of Anton Paar: the storage (elastic) or loss (viscous) modulus came out negative, and 0 is written in its place.
bool tells_negative_modulus(std::string_view flag) {
    return flag == "ME-" || flag == "MV-";
}

bool converts(const std::string& from, const std::string& to) {
    try {
        return !from.empty() && std::isfinite(unit_factor(from, to));
    } catch (const InputError&) {
        return false;
    }
}

/// TRIOS gives forces and torques of the ARES in grams, which are those of a weight.
std::string unit_of(const std::string& quantity, const std::string& unit) {
    const bool weight = (quantity == "normal_force" && unit == "g") || (quantity == "torque" && unit == "g.cm");
    return weight ? "gf" + unit.substr(1) : unit;
}

}  // namespace

std::vector<std::string> split_lines(const std::string& text) {
    const char line_end = text.find('\n') == std::string::npos ? '\r' : '\n';  // old programs end lines by a carriage return alone
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(line_end, begin), text.size());
        std::string line = text.substr(begin, end - begin);
        if (line.ends_with('\r')) {
            line.pop_back();
        }
        lines.push_back(std::move(line));
        begin = end + 1;
    }
    return lines;
}

namespace {

/// Where the field that begins here ends.
std::size_t field_end(std::string_view line, char separator, std::size_t begin) {
    const std::size_t first = line.find_first_not_of(' ', begin);
    std::size_t at = begin;
    if (first < line.size() && line[first] == '"') {
        at = first + 1;
        while (at < line.size() && (line[at] != '"' || line.substr(at).starts_with("\"\""))) {
            at += line[at] == '"' ? 2 : 1;
        }
    }
    return std::min(line.find(separator, std::min(at, line.size())), line.size());
}

/// A field without the blanks and quotes around it.
std::string bare_field(std::string_view field) {
    field = trim(field);
    if (field.size() < 2 || field.front() != '"' || field.back() != '"') {
        return std::string(field);
    }
    std::string bare(trim(field.substr(1, field.size() - 2)));
    for (std::size_t at = bare.find("\"\""); at != std::string::npos; at = bare.find("\"\"", at + 1)) {
        bare.erase(at, 1);
    }
    return bare;
}

}  // namespace

std::vector<std::string> split_cells(std::string_view line, char separator) {
    std::vector<std::string> cells;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = field_end(line, separator, begin);
        cells.push_back(bare_field(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    return cells;
}

char separator_in(std::string_view line) {
    for (const char separator : {'\t', ';', ','}) {
        if (line.find(separator) != std::string_view::npos) {
            return separator;
        }
    }
    return ',';
}

bool is_blank(const std::vector<std::string>& cells) {
    return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
}

int announced_count(std::string_view text) {
    const CellNumber number = read_cell(text, false);
    return number.value && *number.value >= 1 && *number.value < 1e9 ? static_cast<int>(*number.value) : 0;
}

PlainColumn plain_column(HeadingWithUnit heading) {
    KnownHeading known = known_heading(heading.heading);
    if (known.quantity == "frequency" && converts(heading.unit, "rad/s")) {
        known.quantity = "angular_frequency";
    }
    std::string unit = unit_of(known.quantity, heading.unit);
    return {std::move(heading.heading), std::move(known.quantity), std::move(unit), known.rank};
}

TableBuilder::TableBuilder(const std::vector<HeadingWithUnit>& headings, bool decimal_comma) : decimal_comma_(decimal_comma) {
    for (const HeadingWithUnit& heading : headings) {
        table_.columns.push_back(plain_column(heading));
        is_status_.push_back(is_one_of(status_headings, heading.heading));
        is_clock_.push_back(is_one_of(clock_headings, heading.heading));
    }
    has_number_.assign(headings.size(), false);
}

void TableBuilder::add_row(const std::vector<std::string>& cells) {
    std::string clock;
    for (std::size_t column = 0; column < table_.columns.size(); ++column) {
        const std::string text = column < cells.size() ? cells[column] : "";
        if (is_status_[column]) {
            add_flags(text);
        }
        if (is_clock_[column]) {
            clock += (clock.empty() ? "" : " ") + text;
        }
        const CellNumber cell = read_cell(text, decimal_comma_);
        table_.columns[column].values.push_back(cell.value.value_or(no_value));
        has_number_[column] = has_number_[column] || cell.value;
        if (!cell.complaint.empty()) {
            table_.unreadable.push_back({column, rows_, text, cell.complaint});
        }
    }
    note_clock(clock);
    ++rows_;
}

/// Day and time may stand in two columns.
void TableBuilder::note_clock(const std::string& date_and_time) {
    const auto date = date_and_time.empty() ? std::nullopt : seconds_of_date(date_and_time);
    const auto time_of_day = date_and_time.empty() || date ? std::nullopt : seconds_of_day(date_and_time);
    clock_.push_back(date ? *date : time_of_day.value_or(no_value));
}

/// What the clock tells, a day more each time that midnight has passed, whether the rows stand in the order of time or against it;
/// rows without a time are left out.
std::vector<double> TableBuilder::unbroken_clock() const {
    std::vector<double> times;
    double days = 0;
    for (const double time : clock_) {
        if (std::isnan(time)) {
            continue;
        }
        const double before = times.empty() ? time : times.back() - days;
        days += time < day && before < day ? day * std::round((before - time) / day) : 0;
        times.push_back(time + days);
    }
    return times;
}

/// The clock shows when a row was finished, so that the first began a row earlier; NaN without a clock.
double TableBuilder::start_by_clock() const {
    const std::vector<double> times = unbroken_clock();
    if (times.size() < 2) {
        return times.empty() ? unset : times.front();
    }
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    return *first - (*last - *first) / static_cast<double>(times.size() - 1);
}

/// Where every row has a time of day and the table has no times.
void TableBuilder::add_times_by_clock() {
    std::vector<double> times = unbroken_clock();
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    if (times.size() < rows_ || times.size() < 2 || !(*first < *last) || column_of("time") < table_.columns.size()) {
        return;
    }
    const double start = start_by_clock();
    std::for_each(times.begin(), times.end(), [&](double& time) { time -= start; });
    const auto clock = std::find(is_clock_.begin(), is_clock_.end(), true) - is_clock_.begin();
    table_.columns.push_back({table_.columns[static_cast<std::size_t>(clock)].heading, "time", "s", 0, std::move(times)});
    has_number_.push_back(true);
}

void TableBuilder::add_flags(const std::string& status) {
    for (const std::string& part : split_cells(status, ',')) {
        const std::string flag = part.substr(0, part.find('"'));  // a quote that a spreadsheet left over
        if (!flag.empty()) {
            ++flags_[flag];
            if (tells_negative_modulus(flag) && (negative_moduli_.empty() || negative_moduli_.back() != rows_)) {
                negative_moduli_.push_back(rows_);
            }
        }
    }
}

std::size_t TableBuilder::column_of(std::string_view quantity) const {
    std::size_t best = table_.columns.size();
    for (std::size_t column = 0; column < table_.columns.size(); ++column) {
        const bool fits = table_.columns[column].quantity == quantity && has_number_[column];
        if (fits && (best == table_.columns.size() || table_.columns[column].rank < table_.columns[best].rank)) {
            best = column;
        }
    }
    return best;
}

void TableBuilder::take_out(std::size_t column, std::size_t row, const std::string& reason) {
    double& value = table_.columns[column].values[row];
    table_.unreadable.push_back({column, row, to_text(value), reason});
    value = no_value;
}

void TableBuilder::take_out_loss_tangent_limit() {
    const std::size_t tangent = column_of("loss_tangent");
    const std::size_t storage = column_of("storage_modulus");
    const std::size_t loss = column_of("loss_modulus");
    for (std::size_t row = 0; tangent < table_.columns.size() && row < rows_; ++row) {
        if (table_.columns[tangent].values[row] != loss_tangent_limit) {
            continue;
        }
        take_out(tangent, row, "stands for no value");
        if (storage < table_.columns.size() && loss < table_.columns.size()) {
            const double from_limit = table_.columns[loss].values[row] / loss_tangent_limit;
            if (std::abs(table_.columns[storage].values[row] - from_limit) <= 1e-3 * std::abs(from_limit)) {
                take_out(storage, row, "follows from a loss tangent that stands for no value");
            }
        }
    }
}

void TableBuilder::take_out_negative_moduli() {
    for (const char* quantity : {"storage_modulus", "loss_modulus"}) {
        const std::size_t column = column_of(quantity);
        for (std::size_t k = 0; column < table_.columns.size() && k < negative_moduli_.size(); ++k) {
            if (table_.columns[column].values[negative_moduli_[k]] == 0) {
                take_out(column, negative_moduli_[k], "stands for a negative value, as the flag ME- or MV- says");
            }
        }
    }
}

PlainTable TableBuilder::take(std::string title, int section, bool keep_all) {
    take_out_loss_tangent_limit();
    take_out_negative_moduli();
    add_times_by_clock();
    PlainTable kept;
    kept.title = std::move(title);
    kept.section = section;
    kept.date = start_by_clock();
    kept.flags.assign(flags_.begin(), flags_.end());
    std::vector<std::optional<std::size_t>> place(table_.columns.size());  // of a column among those kept
    for (std::size_t column = 0; column < table_.columns.size(); ++column) {
        if (keep_all || has_number_[column] || !table_.columns[column].quantity.empty()) {
            place[column] = kept.columns.size();
            kept.columns.push_back(std::move(table_.columns[column]));
        }
    }
    for (UnreadableCell& cell : table_.unreadable) {
        if (place[cell.column]) {
            kept.unreadable.push_back({*place[cell.column], cell.row, std::move(cell.text), std::move(cell.reason)});
        }
    }
    return kept;
}

void MeasuredText::fail(std::size_t line, const std::string& rule) const {
    throw InputError(path + ", line " + std::to_string(number(line)) + ": " + rule);
}

MeasuredText measured_text(const std::string& path, const std::string& text) {
    constexpr std::size_t fewest = 8;  // lines
    MeasuredText measured{path, split_lines(text)};
    std::vector<std::string>& lines = measured.lines;
    bool doubled = lines.size() >= fewest;
    for (std::size_t line = 1; doubled && line < lines.size(); line += 2) {
        doubled = trim(lines[line]).empty();
    }
    if (doubled) {
        std::vector<std::string> filled;
        for (std::size_t line = 0; line < lines.size(); line += 2) {
            filled.push_back(std::move(lines[line]));
        }
        lines = std::move(filled);
        measured.spacing = 2;
    }
    return measured;
}

void MissingCells::add(const MeasuredText& text, std::size_t line, std::size_t headings, std::size_t cells) {
    constexpr std::size_t most_missing = 1000000;
    missing_ += headings - std::min(headings, cells);
    if (missing_ > most_missing) {
        text.fail(line, "the rows up to here lack " + std::to_string(missing_) + " cells that the headings name; write every cell");
    }
}

bool has_decimal_comma(const MeasuredText& text, char separator) {
    DecimalCommaVote vote;
    for (const std::string& line : text.lines) {
        const std::vector<std::string> cells = split_cells(line, separator);
        for (std::size_t i = 0; cells.size() > 1 && i < cells.size(); ++i) {
            vote.add(cells[i]);
        }
    }
    return vote.comma_wins();
}

}  // namespace coagula::io
