// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv_reader.hpp"

#include "measured_text.hpp"

#include <algorithm>
#include <utility>

namespace coagula::io {

namespace {

constexpr char blanks = ' ';  ///< stands for runs of blanks and tabs

/// The fields of a line; double quotes around a field are dropped, and separators within them do not split.
std::vector<std::string_view> split_fields(std::string_view line, char separator) {
    std::vector<std::string_view> fields = separator == blanks ? split_words(line) : std::vector<std::string_view>{};
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; separator != blanks && i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') {
            quoted = !quoted;
        }
        if (i == line.size() || (line[i] == separator && !quoted)) {
            fields.push_back(trim(line.substr(begin, i - begin)));
            begin = i + 1;
        }
    }
    for (std::string_view& field : fields) {
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
            field = trim(field.substr(1, field.size() - 2));
        }
    }
    return fields;
}

/// The fields of a header. Where blanks separate, a unit in brackets belongs to the word before it: "x [um] y [um]".
std::vector<std::string_view> split_header(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    for (const std::string_view field : split_fields(line, separator)) {
        if (separator == blanks && !fields.empty() && (field.starts_with('[') || field.starts_with('('))) {
            fields.back() = {fields.back().data(), static_cast<std::size_t>(field.data() + field.size() - fields.back().data())};
        } else {
            fields.push_back(field);
        }
    }
    return fields;
}

/// A number with a decimal point, or with a decimal comma where commas do not separate.
bool is_number(std::string_view field, char separator) {
    std::string text(field);
    if (const std::size_t comma = text.find(','); separator != ',' && comma != std::string::npos && comma + 1 < text.size()) {
        text[comma] = '.';
    }
    return read_number(text).has_value();
}

/// The separator of a line of numbers; nothing when it holds something else.
std::optional<char> separator_of_numbers(std::string_view line) {
    for (const char separator : {';', '\t', ',', blanks}) {
        const auto fields = split_fields(line, separator);
        const auto is_one = [&](std::string_view field) { return is_number(field, separator); };
        if (fields.size() > 1 && std::all_of(fields.begin(), fields.end(), is_one)) {
            return separator;
        }
    }
    return std::nullopt;
}

/// The headings in the last comment that has as many of them as there are fields: "# x, y, z", "#x_y_z_r", "#format x_y_z_r"
/// (Yade).
std::vector<std::string_view> commented_header(const std::vector<std::string_view>& comments, char separator, std::size_t fields) {
    for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment) {
        std::string_view text = trim(comment->substr(std::min(comment->find_first_not_of('#'), comment->size())));
        text = trim(text.starts_with("format ") ? text.substr(7) : text);
        for (const char candidate : {separator, blanks, ',', ';', '\t', '_'}) {
            auto headings = split_header(text, candidate);
            if (headings.size() == fields) {
                return headings;
            }
        }
    }
    return {};
}

/// The separator of a header and of the lines below it, of which `first` is one.
char separator_of(std::string_view header, std::string_view first) {
    const std::optional<char> of_numbers = separator_of_numbers(first);
    if (of_numbers && split_header(header, *of_numbers).size() == split_fields(first, *of_numbers).size()) {
        return *of_numbers;
    }
    char found = ',';
    for (const char separator : {'\t', ';', ','}) {
        found = header.find(separator) != std::string_view::npos ? separator : found;
    }
    const std::size_t words = split_header(header, blanks).size();
    const bool agree = split_header(header, found).size() == split_fields(first, found).size();
    return !agree && words > 1 && words == split_fields(first, blanks).size() ? blanks : found;
}

CsvReader::Column parse_heading(std::string_view field, std::size_t index) {
    HeadingWithUnit parts = split_heading(field);
    return {lower_case(parts.heading), std::move(parts.unit), index};
}

}  // namespace

CsvReader::CsvReader(LineReader& file) : file_(&file) {
    std::vector<std::string_view> comments;
    LineReader::Place before = file.place();
    bool found = file.next_filled();
    while (found && trim(file.line()).starts_with('#')) {
        comments.push_back(trim(file.line()));
        before = file.place();
        found = file.next_filled();
    }
    if (!found) {
        throw InputError(file.path() + " has no header");
    }
    if (const auto separator = separator_of_numbers(file.line())) {
        separator_ = *separator;
        fields_ = commented_header(comments, separator_, split_fields(file.line(), separator_).size());
    }
    if (!fields_.empty()) {
        file.return_to(before);
    } else {
        read_header();
    }
    for (std::size_t index = 0; index < fields_.size(); ++index) {
        columns_.push_back(parse_heading(fields_[index], index));
    }
}

/// The line is the header; the one below it shows what separates.
void CsvReader::read_header() {
    const LineReader::Place header = file_->place();
    const std::string_view first = file_->next_filled() ? file_->line() : header.line;
    file_->return_to(header);
    separator_ = separator_of(header.line, first);
    fields_ = split_header(header.line, separator_);
}

std::optional<CsvReader::Column> CsvReader::find(std::string_view name) const {
    const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.name == name; });
    return found == columns_.end() ? std::nullopt : std::optional(*found);
}

std::vector<std::string> CsvReader::names() const {
    std::vector<std::string> names;
    names.reserve(columns_.size());
    for (const Column& column : columns_) {
        names.push_back(column.name);
    }
    return names;
}

double CsvReader::number(const Column& column) {
    const std::string_view field = fields_[column.index];
    const bool point = field.find('.') != std::string_view::npos;
    const bool comma = separator_ != ',' && field.find(',') != std::string_view::npos;
    commas_ = commas_ || comma;
    points_ = points_ || point;
    if (commas_ && points_ && (comma || point)) {
        file_->fail(column.name + " is '" + std::string(field) + "', but the file has decimal commas and decimal points");
    }
    std::string text(field);
    if (comma) {
        text[text.find(',')] = '.';
    }
    return file_->number_in(text, column.name);
}

bool CsvReader::next() {
    if (!file_->next_filled()) {
        return false;
    }
    fields_ = split_fields(file_->line(), separator_);
    if (fields_.size() != columns_.size()) {
        file_->fail("there are " + std::to_string(fields_.size()) + " fields, but the header names " +
                    std::to_string(columns_.size()));
    }
    return true;
}

}  // namespace coagula::io
