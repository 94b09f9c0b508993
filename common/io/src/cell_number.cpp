// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_number.hpp"

#include "text_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace coagula::io {

namespace {

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

/// Joins groups of digits that blanks or apostrophes part: "1 234,5", "1'234.5", also with a no-break space; the typographic minus
/// becomes a hyphen.
std::string without_blanks(std::string_view text) {
    std::string joined;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i).starts_with("\xe2\x88\x92")) {
            joined.push_back('-');
            i += 2;
            continue;
        }
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

/// Larger numbers, such as the largest of single precision, are what an instrument writes where its arithmetic fails.
constexpr double largest_value = 1e37;

constexpr std::array placeholders = {"-",    "--",       "---",       "n/a", "na", "n.a.",    "nan",  "-nan", "nan(ind)", "inf",
                                     "-inf", "infinity", "-infinity", "∞",   "-∞", "invalid", "none", "null", "undefined"};

}  // namespace

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
        return {std::nullopt, stands_for_no_value(joined) ? "stands for no value" : "is not a number"};
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
    if (std::abs(value) >= largest_value) {
        return {std::nullopt, "stands for no value"};
    }
    return {parts->negative ? -value : value, ""};
}

bool looks_like_number(std::string_view text) {
    return read_cell(text, true).value.has_value() || read_cell(text, false).value.has_value();
}

bool stands_for_no_value(std::string_view text) {
    const std::string word = lower_case(trim(text));
    const bool stars = !word.empty() && word.find_first_not_of("*#?") == std::string::npos;
    const bool spreadsheet_error = word.size() > 2 && word.front() == '#' && (word.back() == '!' || word.back() == '?');
    return stars || spreadsheet_error || word == "#n/a" || word.starts_with("invalid") ||
           std::find(placeholders.begin(), placeholders.end(), word) != placeholders.end();
}

}  // namespace coagula::io
