#include "csv_reader.hpp"

#include "measured_text.hpp"

#include <algorithm>
#include <utility>

namespace coagula::io {

namespace {

/// The fields of a line; double quotes around a field are dropped, and separators within them do not split.
void split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
    fields.clear();
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') {
            quoted = !quoted;
        }
        if (i == line.size() || (line[i] == separator && !quoted)) {
            std::string_view field = trim(line.substr(begin, i - begin));
            if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
                field = trim(field.substr(1, field.size() - 2));
            }
            fields.push_back(field);
            begin = i + 1;
        }
    }
}

CsvReader::Column parse_heading(std::string_view field, std::size_t index) {
    HeadingWithUnit parts = split_heading(field);
    return {lower_case(parts.heading), std::move(parts.unit), index};
}

char separator_of(std::string_view header) {
    for (const char separator : {',', ';', '\t'}) {
        if (header.find(separator) != std::string_view::npos) {
            return separator;
        }
    }
    return ',';
}

}  // namespace

CsvReader::CsvReader(LineReader& file) : file_(&file) {
    bool found = file.next_filled();
    while (found && trim(file.line()).starts_with('#')) {
        found = file.next_filled();
    }
    if (!found) {
        throw InputError(file.path() + " has no header");
    }
    separator_ = separator_of(file.line());
    split_fields(file.line(), separator_, fields_);
    for (std::size_t index = 0; index < fields_.size(); ++index) {
        columns_.push_back(parse_heading(fields_[index], index));
    }
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

bool CsvReader::next() {
    if (!file_->next_filled()) {
        return false;
    }
    split_fields(file_->line(), separator_, fields_);
    if (fields_.size() != columns_.size()) {
        file_->fail("there are " + std::to_string(fields_.size()) + " fields, but the header names " +
                    std::to_string(columns_.size()));
    }
    return true;
}

}  // namespace coagula::io
