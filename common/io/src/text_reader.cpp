// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_reader.hpp"

#include <coagula/common/readable.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/units.hpp>

#include <cctype>
#include <charconv>
#include <cmath>

namespace coagula::io {

LineReader::LineReader(const std::string& path) : path_(path), contents_(read_file(path)) {
    rest_ = contents_;
    if (rest_.starts_with("\xef\xbb\xbf")) {
        rest_.remove_prefix(3);
    }
    if (contents_.find('\0') != std::string::npos) {
        throw InputError(path + " is not a text file");
    }
}

bool LineReader::next() {
    if (rest_.empty()) {
        return false;
    }
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line_.ends_with('\r')) {
        line_.remove_suffix(1);
    }
    ++number_;
    return true;
}

bool LineReader::next_filled() {
    while (next()) {
        if (!trim(line_).empty()) {
            return true;
        }
    }
    return false;
}

void LineReader::fail(const std::string& rule) const {
    throw InputError(path_ + ", line " + std::to_string(number_) + ": " + rule);
}

void LineReader::return_to(const Place& place) {
    rest_ = place.rest;
    line_ = place.line;
    number_ = place.number;
}

double LineReader::number_in(std::string_view field, std::string_view what) const {
    const std::optional<double> value = read_number(trim(field));
    if (!value) {
        fail(std::string(what) + " is '" + std::string(trim(field)) + "', which is not a number");
    }
    if (!std::isfinite(*value)) {
        fail(std::string(what) + " is '" + std::string(trim(field)) + "', but must be finite");
    }
    return *value;
}

std::size_t LineReader::count_in(std::string_view field, std::string_view what) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
        fail(std::string(what) + " is '" + std::string(field) + "', which is not a whole number");
    }
    return value;
}

std::optional<double> read_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) {
        text.remove_prefix(1);
    }
    std::string with_e;
    if (const std::size_t exponent = text.find_first_of("dD"); exponent != std::string_view::npos) {
        with_e = text;
        with_e[exponent] = 'e';
        text = with_e;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole_text = error == std::errc{} && end == text.data() + text.size();
    return whole_text ? std::optional(value) : std::nullopt;
}

bool is_whole_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) {
        text.remove_prefix(1);
    }
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return lower;
}

std::vector<std::string_view> split_words(std::string_view line) {
    std::vector<std::string_view> words;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        const bool at_end = i == line.size();
        if (!at_end && line[i] == '"') {
            quoted = !quoted;
        }
        if (at_end || (!quoted && (line[i] == ' ' || line[i] == '\t'))) {
            if (i > begin) {
                words.push_back(line.substr(begin, i - begin));
            }
            begin = i + 1;
        }
    }
    return words;
}

double per_metre(const LineReader& file, const std::string& object, const std::string& unit, const ImportOptions& options) {
    if (unit.empty()) {
        if (!options.length_unit) {
            file.fail(object + " names no unit: give --length-unit");
        }
        return 1 / require_positive(*options.length_unit, "the length unit", "m");
    }
    double factor = 0;
    try {
        factor = unit_factor("m", unit);
    } catch (const InputError&) {
        file.fail(object + " has the unit '" + unit + "', which is not a length");
    }
    if (options.length_unit && std::abs(*options.length_unit * factor - 1) > 1e-9) {
        file.fail(object + " has the unit '" + unit + "', but --length-unit says " + with_unit(*options.length_unit, "m") +
                  ": leave --length-unit out, or take the unit out of the file");
    }
    return factor;
}

}  // namespace coagula::io
