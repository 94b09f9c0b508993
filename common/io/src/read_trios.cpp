// Text exports of TA Instruments TRIOS. Lines "key <tab> value", sections in brackets, and then, per step, either
//     [step]                                [step]
//     <name of the step>                    Step name  <name>
//     <headings>                            Number of points  <points>
//     <units>                               Variables   <headings>
//     <cells>                                           <units>
//                                           Data point  <cells>
// the second when exported for a LIMS, where the first column is a label. There is no public specification: this is what programs
// that read such files expect.
#include "measured_text.hpp"

#include "text_reader.hpp"

#include <algorithm>

namespace coagula::io {

namespace {

constexpr char tab = '\t';

bool is_step(const std::string& line) {
    return lower_case(trim(line)) == "[step]";
}

bool is_section(const std::string& line) {
    const std::string_view text = trim(line);
    return text.size() > 2 && text.front() == '[' && text.back() == ']' && text.find(tab) == std::string_view::npos;
}

/// Where the parts of a step stand.
struct StepHead {
    std::string title;
    std::size_t headings;  ///< line
    int announced_points = 0;
    bool labelled = false;  ///< the first column is a label
};

StepHead read_head(const MeasuredText& text, std::size_t step) {
    StepHead head;
    for (std::size_t line = step + 1; line < text.lines.size() && !is_section(text.lines[line]); ++line) {
        const std::vector<std::string> cells = split_cells(text.lines[line], tab);
        const std::string key = lower_case(cells.front());
        if (key == "step name" && cells.size() > 1) {
            head.title = cells[1];
        } else if (key == "number of points" && cells.size() > 1) {
            const CellNumber points = read_cell(cells[1], false);
            head.announced_points = points.value && *points.value > 0 && *points.value < 1e9 ? static_cast<int>(*points.value) : 0;
        } else if (cells.size() > 1 && std::any_of(cells.begin(), cells.end(),
                                                   [](const std::string& cell) { return !quantity_of_heading(cell).empty(); })) {
            head.headings = line;
            head.labelled = key == "variables";
            return head;
        } else if (head.title.empty() && cells.size() == 1) {
            head.title = cells.front();
        }
    }
    text.fail(step, "this step has no line of headings that names a known quantity");
}

std::vector<std::string> row_of(const std::string& line, bool labelled) {
    std::vector<std::string> cells = split_cells(line, tab);
    if (labelled) {
        cells.erase(cells.begin());
    }
    return cells;
}

std::vector<HeadingWithUnit> headings_of(const MeasuredText& text, const StepHead& head) {
    if (head.headings + 1 >= text.lines.size()) {
        text.fail(head.headings, "the file ends after the headings");
    }
    std::vector<HeadingWithUnit> headings;
    for (std::string& heading : row_of(text.lines[head.headings], head.labelled)) {
        headings.push_back({std::move(heading), ""});
    }
    const std::vector<std::string> units = row_of(text.lines[head.headings + 1], head.labelled);
    for (std::size_t column = 0; column < std::min(units.size(), headings.size()); ++column) {
        headings[column].unit = units[column];
    }
    return headings;
}

bool find_decimal_comma(const MeasuredText& text) {
    DecimalCommaVote vote;
    for (const std::string& line : text.lines) {
        const std::vector<std::string> cells = split_cells(line, tab);
        for (std::size_t i = 0; cells.size() > 2 && i < cells.size(); ++i) {
            vote.add(cells[i]);
        }
    }
    return vote.comma_wins();
}

}  // namespace

bool looks_like_trios(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(), is_step);
}

MeasuredFile read_trios(const MeasuredText& text) {
    MeasuredFile file{text.path, MeasuredFormat::trios, find_decimal_comma(text), {}, {}};
    MissingCells missing;
    for (std::size_t line = 0; line < text.lines.size();) {
        if (!is_step(text.lines[line])) {
            const std::vector<std::string> cells = split_cells(text.lines[line], tab);
            if (cells.size() == 2 && !cells[0].empty()) {
                file.metadata.emplace_back(cells[0], cells[1]);
            }
            ++line;
            continue;
        }
        const StepHead head = read_head(text, line);
        std::vector<HeadingWithUnit> headings = headings_of(text, head);
        const std::size_t columns = headings.size();
        TableBuilder table(std::move(headings), file.decimal_comma);
        for (line = head.headings + 2; line < text.lines.size() && !trim(text.lines[line]).empty() && !is_section(text.lines[line]);
             ++line) {
            const std::vector<std::string> row = row_of(text.lines[line], head.labelled);
            missing.add(text, line, columns, row.size());
            table.add_row(row);
        }
        file.tables.push_back(table.take(head.title, static_cast<int>(file.tables.size()) + 1));
        file.tables.back().announced_points = head.announced_points;
    }
    return file;
}

}  // namespace coagula::io
