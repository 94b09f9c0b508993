// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_set.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/readable.hpp>
#include <coagula/common/spelling.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace coagula::stages {

namespace {

constexpr std::size_t most_series = 12;
constexpr std::size_t most_panels = 3;

const io::SetColumn& column_of(const Arguments& arguments, const io::SetHead& set, const std::string& option) {
    const std::string& name = arguments.text(option);
    if (const io::SetColumn* column = set.column(name)) {
        return *column;
    }
    std::vector<std::string> names;
    std::transform(set.index.begin(), set.index.end(), std::back_inserter(names), [](const auto& column) { return column.name; });
    throw InputError(arguments.spelled(option) + ": " + arguments.input() + " has no column '" + name + "'" +
                     did_you_mean(name, names) + " (see 'coagula dataset table')");
}

std::vector<double> numbers_of(const Arguments& arguments, const io::SetHead& set, const std::string& option) {
    const io::SetColumn& column = column_of(arguments, set, option);
    if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values)) {
        return {wholes->begin(), wholes->end()};
    }
    const auto* numbers = std::get_if<std::vector<double>>(&column.values);
    if (numbers == nullptr) {
        throw InputError(arguments.spelled(option) + ": the column '" + column.name +
                         "' holds texts, which have no place on an axis");
    }
    return *numbers;
}

/// The values of a column as words, and which row has which; one group of all rows without the option.
struct Groups {
    std::vector<std::string> names = {""};
    std::vector<std::size_t> of_row;
};

std::string word_at(const io::SetColumn& column, std::size_t row) {
    if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values)) {
        return (*texts)[row];
    }
    const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values);
    return wholes != nullptr ? std::to_string((*wholes)[row])
                             : with_unit(std::get<std::vector<double>>(column.values)[row], column.unit);
}

Groups groups_of(const Arguments& arguments, const io::SetHead& set, const std::string& option, std::size_t rows,
                 std::size_t most) {
    if (!arguments.has(option)) {
        return {{""}, std::vector<std::size_t>(rows, 0)};
    }
    const io::SetColumn& column = column_of(arguments, set, option);
    Groups groups{{}, {}};
    for (std::size_t row = 0; row < rows; ++row) {
        const std::string word = column.name + " " + word_at(column, row);
        const auto found = std::find(groups.names.begin(), groups.names.end(), word);
        groups.of_row.push_back(static_cast<std::size_t>(found - groups.names.begin()));
        if (found == groups.names.end()) {
            groups.names.push_back(word);
        }
    }
    if (groups.names.size() > most) {
        throw InputError(arguments.spelled(option) + ": the column '" + column.name + "' has " +
                         std::to_string(groups.names.size()) + " different values, and at most " + std::to_string(most) +
                         " can be drawn");
    }
    return groups;
}

/// The name without what gnuplot would take for markup.
report::ChartAxis axis_of(const io::SetColumn& column) {
    std::string words = column.name;
    std::replace_if(
        words.begin(), words.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, ' ');
    return {.name = words, .plain = column.name, .unit = column.unit.empty() ? "1" : column.unit};
}

}  // namespace

report::Drawing drawing_of_set(const Arguments& arguments, const io::SetHead& set) {
    const std::vector<double> x = numbers_of(arguments, set, "x");
    const std::vector<double> y = numbers_of(arguments, set, "y");
    const Groups series = groups_of(arguments, set, "colour", x.size(), most_series);
    const Groups panels = groups_of(arguments, set, "facet", x.size(), most_panels);
    report::Drawing drawing;
    for (std::size_t panel = 0; panel < panels.names.size(); ++panel) {
        report::Chart chart{.x = axis_of(column_of(arguments, set, "x")), .y = axis_of(column_of(arguments, set, "y"))};
        for (std::size_t number = 0; number < series.names.size(); ++number) {
            report::Series points{.name = series.names[number],
                                  .mark = report::Mark::points,
                                  .colour = static_cast<int>(number),
                                  .per_structure = true};
            for (std::size_t row = 0; row < x.size(); ++row) {
                if (panels.of_row[row] == panel && series.of_row[row] == number && std::isfinite(x[row]) && std::isfinite(y[row])) {
                    points.x.push_back(x[row]);
                    points.y.push_back(y[row]);
                }
            }
            if (!points.x.empty()) {
                chart.series.push_back(std::move(points));
            }
        }
        if (!panels.names[panel].empty()) {
            chart.notes.push_back(panels.names[panel]);
        }
        if (chart.series.empty()) {
            throw InputError(arguments.input() + ": no structure has both " + arguments.text("x") + " and " + arguments.text("y") +
                             (panels.names[panel].empty() ? "" : " where " + panels.names[panel]));
        }
        drawing.panels.push_back(std::move(chart));
    }
    drawing.caption = arguments.text("y") + " against " + arguments.text("x") + " of the structures in " + arguments.input() + ".";
    return drawing;
}

}  // namespace coagula::stages
