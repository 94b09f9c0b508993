#include <algorithm>
#include <array>

#include "text_reader.hpp"

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

/// A header field such as "x [um]" or "radius (nm)".
struct Heading {
    std::string name;  ///< in lower case
    std::string unit;  ///< empty when none is named
};

Heading parse_heading(std::string_view field) {
    const std::size_t open = field.find_first_of("[(");
    if (open == std::string_view::npos || field.size() < open + 2) {
        return {lower_case(trim(field)), ""};
    }
    return {lower_case(trim(field.substr(0, open))), std::string(trim(field.substr(open + 1, field.size() - open - 2)))};
}

/// Where a quantity stands and how many of its unit are in a metre.
struct Column {
    std::string name;
    std::size_t index;
    double divisor;
};

char separator_of(std::string_view header) {
    for (const char separator : {',', ';', '\t'}) {
        if (header.find(separator) != std::string_view::npos) {
            return separator;
        }
    }
    return ',';
}

/// The first of `names` among the headings.
std::optional<Column> find_column(const LineReader& file, const std::vector<std::string_view>& header,
                                  const std::vector<std::string>& names, const ImportOptions& options) {
    for (const std::string& name : names) {
        for (std::size_t index = 0; index < header.size(); ++index) {
            const Heading heading = parse_heading(header[index]);
            if (heading.name == name) {
                return Column{name, index, per_metre(file, "column " + name, heading.unit, options)};
            }
        }
    }
    return std::nullopt;
}

std::vector<Column> find_columns(const LineReader& file, const std::vector<std::string_view>& header,
                                 const ImportOptions& options) {
    std::vector<Column> columns;
    for (const char* name : {"x", "y", "z"}) {
        const auto column = find_column(file, header, {name}, options);
        if (!column) {
            file.fail(std::string("there is no column ") + name + "; the first line must be a header that names x, y and z");
        }
        columns.push_back(*column);
    }
    if (!options.radius) {
        if (const auto radius = find_column(file, header, {"radius", "rad", "r"}, options)) {
            columns.push_back(*radius);
        }
    }
    return columns;
}

}  // namespace

RawPacking read_csv(LineReader& file, const ImportOptions& options) {
    bool found = file.next_filled();
    while (found && trim(file.line()).starts_with('#')) {
        found = file.next_filled();
    }
    if (!found) {
        throw InputError(file.path() + " has no header");
    }
    const char separator = separator_of(file.line());
    std::vector<std::string_view> fields;
    split_fields(file.line(), separator, fields);
    const std::size_t width = fields.size();
    const std::vector<Column> columns = find_columns(file, fields, options);
    RawPacking raw;
    while (file.next_filled()) {
        split_fields(file.line(), separator, fields);
        if (fields.size() != width) {
            file.fail("there are " + std::to_string(fields.size()) + " fields, but the header names " + std::to_string(width));
        }
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double value = file.number_in(fields[columns[i].index], columns[i].name) / columns[i].divisor;
            (i < 3 ? raw.coordinates : raw.radii).push_back(value);
        }
        raw.lines.push_back(file.number());
    }
    return raw;
}

}  // namespace coagula::io
