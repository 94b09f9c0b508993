#include <coagula/common/checks.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/measured_file.hpp>

#include "measured_text.hpp"
#include "text_reader.hpp"

#include <algorithm>

namespace coagula::io {

namespace {

bool is_skipped(const std::string& line) {
    return trim(line).empty() || trim(line).starts_with('#');
}

}  // namespace

std::string_view name_of(MeasuredFormat format) {
    switch (format) {
        case MeasuredFormat::csv:
            return "CSV";
        case MeasuredFormat::rheocompass:
            return "RheoCompass";
        case MeasuredFormat::trios:
            return "TRIOS";
    }
    return "";
}

MeasuredFile read_measured_csv(const MeasuredText& text) {
    const auto header = std::find_if_not(text.lines.begin(), text.lines.end(), is_skipped);
    if (header == text.lines.end()) {
        throw InputError(text.path + " has no header");
    }
    const char separator = separator_in(*header);
    const std::vector<std::string> fields = split_cells(*header, separator);
    std::vector<HeadingWithUnit> headings(fields.size());
    std::transform(fields.begin(), fields.end(), headings.begin(), [](const std::string& field) { return split_heading(field); });
    std::vector<std::vector<std::string>> rows;
    DecimalCommaVote vote;
    for (auto line = header + 1; line != text.lines.end(); ++line) {
        if (is_skipped(*line)) {
            continue;
        }
        rows.push_back(split_cells(*line, separator));
        if (rows.back().size() != fields.size()) {
            text.fail(static_cast<std::size_t>(line - text.lines.begin()), "there are " + std::to_string(rows.back().size()) +
                                                                               " fields, but the header names " +
                                                                               std::to_string(fields.size()));
        }
        std::for_each(rows.back().begin(), rows.back().end(), [&](const std::string& cell) { vote.add(cell); });
    }
    MeasuredFile file{text.path, MeasuredFormat::csv, vote.comma_wins(), {}, {}};
    TableBuilder table(std::move(headings), file.decimal_comma);
    for (const std::vector<std::string>& row : rows) {
        table.add_row(row);
    }
    file.tables.push_back(table.take("", 1));
    return file;
}

MeasuredFile read_measured_file(const std::string& path) {
    const std::string bytes = read_file(path);
    const MeasuredText text{path, split_lines(to_utf8(bytes))};
    if (std::any_of(text.lines.begin(), text.lines.end(), [](const std::string& line) { return line.find('\0') != line.npos; })) {
        throw InputError(path + " is not a text file");
    }
    if (looks_like_rheocompass(text)) {
        return read_rheocompass(text);
    }
    return looks_like_trios(text) ? read_trios(text) : read_measured_csv(text);
}

}  // namespace coagula::io
