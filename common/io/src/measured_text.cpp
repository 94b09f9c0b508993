#include "measured_text.hpp"

#include "text_reader.hpp"
#include "utf8.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace coagula::io {

namespace {

void append_utf8(std::string& text, std::uint32_t code) {
    const auto byte = [&](std::uint32_t bits) { text.push_back(static_cast<char>(bits)); };
    if (code < 0x80) {
        byte(code);
    } else if (code < 0x800) {
        byte(0xc0 | code >> 6);
        byte(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        byte(0xe0 | code >> 12);
        byte(0x80 | (code >> 6 & 0x3f));
        byte(0x80 | (code & 0x3f));
    } else {
        byte(0xf0 | code >> 18);
        byte(0x80 | (code >> 12 & 0x3f));
        byte(0x80 | (code >> 6 & 0x3f));
        byte(0x80 | (code & 0x3f));
    }
}

constexpr std::uint32_t replacement = 0xfffd;

std::string from_utf16(std::string_view bytes, bool big_endian) {
    const auto unit = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(big_endian ? first << 8 | second : second << 8 | first);
    };
    std::string text;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        const std::uint32_t code = unit(i);
        if (code < 0xd800 || code > 0xdfff) {
            append_utf8(text, code);
            continue;
        }
        const bool paired = code < 0xdc00 && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) <= 0xdfff;
        append_utf8(text, paired ? 0x10000 + ((code - 0xd800) << 10) + (unit(i + 2) - 0xdc00) : replacement);
        i += paired ? 2 : 0;
    }
    return text;
}

/// Windows-1252 but for its 27 printable characters between 0x80 and 0x9f, of which the trade mark sign alone is of interest here.
std::string from_windows_1252(std::string_view bytes) {
    std::string text;
    for (const char c : bytes) {
        const auto code = static_cast<unsigned char>(c);
        append_utf8(text, code == 0x99 ? 0x2122 : code >= 0x80 && code < 0xa0 ? replacement : code);
    }
    return text;
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// A number taken apart: sign, digits before and after the last separator, exponent.
struct NumberParts {
    std::string_view mantissa;  ///< digits, points and commas
    std::string_view exponent;  ///< "E+05" or empty
    bool negative = false;
};

std::optional<NumberParts> take_apart(std::string_view text) {
    NumberParts parts;
    if (text.starts_with('-') || text.starts_with('+')) {
        parts.negative = text.front() == '-';
        text.remove_prefix(1);
    }
    const auto end = std::min(text.find_first_of("eE"), text.size());
    parts.mantissa = text.substr(0, end);
    parts.exponent = text.substr(end);
    const auto allowed = [](char c) { return is_digit(c) || c == '.' || c == ','; };
    if (parts.mantissa.empty() || !std::all_of(parts.mantissa.begin(), parts.mantissa.end(), allowed) ||
        std::none_of(parts.mantissa.begin(), parts.mantissa.end(), is_digit)) {
        return std::nullopt;
    }
    return parts;
}

/// The digits with the groups joined and a decimal point; nothing when the groups are not of three digits.
std::optional<std::string> plain_digits(std::string_view mantissa, char decimal, char group) {
    const std::size_t comma = mantissa.find(decimal);
    const std::string_view whole = mantissa.substr(0, comma);
    const std::string_view fraction = comma == std::string_view::npos ? std::string_view{} : mantissa.substr(comma + 1);
    if (fraction.find_first_of(".,") != std::string_view::npos) {
        return std::nullopt;
    }
    std::string digits;
    std::size_t begin = 0;
    for (std::size_t part = 0;; ++part) {
        const std::size_t end = whole.find(group, begin);
        const std::string_view digits_of_group = whole.substr(begin, end == std::string_view::npos ? end : end - begin);
        const bool grouped = part > 0 || end != std::string_view::npos;
        const bool wrong_size = part > 0 ? digits_of_group.size() != 3 : digits_of_group.empty() || digits_of_group.size() > 3;
        if (grouped && (wrong_size || whole.front() == '0')) {
            return std::nullopt;
        }
        digits += digits_of_group;
        if (end == std::string_view::npos) {
            break;
        }
        begin = end + 1;
    }
    return digits + (fraction.empty() ? "" : "." + std::string(fraction));
}

/// Joins groups of digits that blanks or apostrophes part: "1 234,5", "1'234.5", also with a no-break space.
std::string without_blanks(std::string_view text) {
    std::string joined;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t width = text.substr(i).starts_with("\xc2\xa0")       ? 2
                                  : text.substr(i).starts_with("\xe2\x80\xaf") ? 3
                                  : text[i] == ' ' || text[i] == '\''          ? 1
                                                                               : 0;
        const bool parts_digits = width > 0 && i > 0 && is_digit(text[i - 1]) && i + width + 2 < text.size() &&
                                  is_digit(text[i + width]) && is_digit(text[i + width + 1]) && is_digit(text[i + width + 2]);
        if (parts_digits) {
            i += width - 1;
        } else {
            joined.push_back(text[i]);
        }
    }
    return joined;
}

}  // namespace

std::string to_utf8(std::string_view bytes) {
    if (bytes.starts_with("\xff\xfe")) {
        return from_utf16(bytes.substr(2), false);
    }
    if (bytes.starts_with("\xfe\xff")) {
        return from_utf16(bytes.substr(2), true);
    }
    if (bytes.starts_with("\xef\xbb\xbf")) {
        bytes.remove_prefix(3);
    }
    return is_utf8(bytes) ? std::string(bytes) : from_windows_1252(bytes);
}

std::vector<std::string> split_lines(const std::string& text) {
    const char line_end = text.find('\n') == text.npos ? '\r' : '\n';  // old programs end lines by a carriage return alone
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

std::vector<std::string> split_cells(std::string_view line, char separator) {
    const auto bare = [](std::string_view field) {
        field = trim(field);
        const bool in_quotes = field.size() >= 2 && field.front() == '"' && field.back() == '"';
        return std::string(in_quotes ? trim(field.substr(1, field.size() - 2)) : field);
    };
    std::vector<std::string> cells;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') {
            quoted = !quoted;
        }
        if (i == line.size() || (line[i] == separator && !quoted)) {
            cells.push_back(bare(line.substr(begin, i - begin)));
            begin = i + 1;
        }
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

void DecimalCommaVote::add(std::string_view cell) {
    const std::string text = without_blanks(cell);
    const auto parts = take_apart(text);
    if (!parts) {
        return;
    }
    const bool as_comma = plain_digits(parts->mantissa, ',', '.').has_value();
    const bool as_point = plain_digits(parts->mantissa, '.', ',').has_value();
    commas_ += as_comma && !as_point ? 1 : 0;
    points_ += as_point && !as_comma ? 1 : 0;
}

CellNumber read_cell(std::string_view text, bool decimal_comma) {
    const std::string joined = without_blanks(trim(text));
    if (joined.empty()) {
        return {};
    }
    const auto parts = take_apart(joined);
    if (!parts) {
        return {std::nullopt, "is not a number"};
    }
    const bool grouped = parts->mantissa.find(decimal_comma ? '.' : ',') != std::string_view::npos;
    const auto digits = plain_digits(parts->mantissa, decimal_comma ? ',' : '.', decimal_comma ? '.' : ',');
    if (!digits || (grouped && !parts->exponent.empty())) {
        return {std::nullopt,
                decimal_comma ? "has a decimal point in a file with decimal commas" : "has a comma in a file with decimal points"};
    }
    const std::string number = *digits + std::string(parts->exponent);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value)) {
        return {std::nullopt, "is not a finite number"};
    }
    return {parts->negative ? -value : value, ""};
}

HeadingWithUnit split_heading(std::string_view text) {
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        const std::size_t begin = text.rfind(open);
        if (begin != std::string_view::npos && begin > 0 && text.ends_with(close)) {
            return {std::string(trim(text.substr(0, begin))), std::string(trim(text.substr(begin + 1, text.size() - begin - 2)))};
        }
    }
    return {std::string(trim(text)), ""};
}

TableBuilder::TableBuilder(std::vector<HeadingWithUnit> headings, bool decimal_comma) : decimal_comma_(decimal_comma) {
    for (HeadingWithUnit& heading : headings) {
        std::string quantity = quantity_of_heading(heading.heading);
        table_.columns.push_back({std::move(heading.heading), std::move(quantity), std::move(heading.unit), {}});
    }
}

void TableBuilder::add_row(const std::vector<std::string>& cells) {
    for (std::size_t column = 0; column < table_.columns.size(); ++column) {
        const std::string text = column < cells.size() ? cells[column] : "";
        const CellNumber cell = read_cell(text, decimal_comma_);
        table_.columns[column].values.push_back(cell.value.value_or(std::numeric_limits<double>::quiet_NaN()));
        if (!cell.complaint.empty()) {
            table_.unreadable.push_back({column, rows_, text, cell.complaint});
        }
    }
    ++rows_;
}

PlainTable TableBuilder::take(std::string title, int section) {
    PlainTable kept;
    kept.title = std::move(title);
    kept.section = section;
    std::vector<std::optional<std::size_t>> place(table_.columns.size());  // of a column among those kept
    for (std::size_t column = 0; column < table_.columns.size(); ++column) {
        PlainColumn& from = table_.columns[column];
        const bool numeric = std::any_of(from.values.begin(), from.values.end(), [](double value) { return !std::isnan(value); });
        if (!numeric && from.quantity.empty()) {
            continue;
        }
        place[column] = kept.columns.size();
        kept.columns.push_back(std::move(from));
    }
    for (UnreadableCell& cell : table_.unreadable) {
        if (place[cell.column]) {
            kept.unreadable.push_back({*place[cell.column], cell.row, std::move(cell.text), std::move(cell.reason)});
        }
    }
    return kept;
}

void MeasuredText::fail(std::size_t line, const std::string& rule) const {
    throw InputError(path + ", line " + std::to_string(line + 1) + ": " + rule);
}

void MissingCells::add(const MeasuredText& text, std::size_t line, std::size_t headings, std::size_t cells) {
    constexpr std::size_t most_missing = 1000000;
    missing_ += headings - std::min(headings, cells);
    if (missing_ > most_missing) {
        text.fail(line, "the rows up to here lack " + std::to_string(missing_) + " cells that the headings name; write every cell");
    }
}

}  // namespace coagula::io
