// SPDX-License-Identifier: GPL-3.0-or-later
// Figures that need no code of their own: a curve of two data sets, a histogram of one.
#include "figure_parts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace coagula::report {

namespace {

bool is_there(const FigureSource& source, const std::string& path) {
    return !path.empty() && source.find(path) != nullptr;
}

/// A line of the legend that says what a kind of line is in all files.
Series key_of(const std::string& name, Mark mark) {
    return {.name = name, .mark = mark, .colour = -1, .key_only = true};
}

/// Reads as many numbers as the curve has abscissae.
std::vector<double> numbers_beside(const FigureSource& source, const CurveFigure& figure, const std::string& path) {
    std::vector<double> numbers = source.numbers(path);
    if (const std::size_t x = source.numbers(figure.x).size(); x != numbers.size()) {
        throw InputError(source.file + ": " + figure.x + " has " + std::to_string(x) + " numbers and " + path + " " +
                         std::to_string(numbers.size()) + ": a curve needs as many of both");
    }
    return numbers;
}

/// Shares of counts at 0, 1, 2 ..., without the empty end.
void add_counts(Series& series, std::vector<double> counts) {
    while (!counts.empty() && counts.back() == 0) {
        counts.pop_back();
    }
    double sum = 0;
    for (const double count : counts) {
        sum += count;
    }
    for (std::size_t k = 0; k < counts.size(); ++k) {
        series.x.push_back(static_cast<double>(k));
        series.y.push_back(sum > 0 ? counts[k] / sum : 0);
    }
}

/// Probability density of numbers in bins of equal width.
void add_density(Series& series, const std::vector<double>& numbers, double low, double high, int bins) {
    const double width = high > low ? (high - low) / bins : 1;
    std::vector<double> counts(static_cast<std::size_t>(bins), 0);
    double all = 0;
    for (const double number : numbers) {
        if (std::isfinite(number)) {
            ++counts[std::min(counts.size() - 1, static_cast<std::size_t>((number - low) / width))];
            ++all;
        }
    }
    for (int bin = 0; bin < bins; ++bin) {
        series.x.push_back(low + (bin + 0.5) * width);
        series.y.push_back(all > 0 ? counts[static_cast<std::size_t>(bin)] / (all * width) : 0);
    }
}

}  // namespace

std::function<Drawing(const Sources&)> curve(CurveFigure figure) {
    return [figure = std::move(figure)](const Sources& sources) {
        Chart chart{.x = figure.x_axis, .y = figure.y_axis, .legend = figure.legend};
        std::vector<Series> others;
        for (std::size_t k = 0; k < sources.size(); ++k) {
            const FigureSource& source = sources[k];
            const bool has_other = is_there(source, figure.other);
            Series series{.name = legend_name(sources, k), .mark = figure.mark, .colour = static_cast<int>(k)};
            series.name = series.name.empty() && has_other ? figure.name : series.name;
            series.x = source.numbers(figure.x);
            series.y = numbers_beside(source, figure, figure.y);
            chart.x.unit = source.unit(figure.x);
            chart.y.unit = source.unit(figure.y);
            if (has_other) {
                Series other{.name = sources.size() > 1 ? "" : figure.other_name,
                             .mark = Mark::dashed_line,
                             .colour = sources.size() > 1 ? series.colour : -1};
                other.x = series.x;
                other.y = numbers_beside(source, figure, figure.other);
                others.push_back(std::move(other));
            }
            if (is_there(source, figure.y_error)) {
                series.error = numbers_beside(source, figure, figure.y_error);
            }
            chart.series.push_back(std::move(series));
        }
        if (sources.size() > 1 && !others.empty()) {
            others.push_back(key_of(figure.name, figure.mark));
            others.push_back(key_of(figure.other_name, Mark::dashed_line));
        }
        std::move(others.begin(), others.end(), std::back_inserter(chart.series));
        return Drawing{.panels = {chart}, .caption = figure.caption};
    };
}

std::function<Drawing(const Sources&)> histogram(HistogramFigure figure) {
    return [figure = std::move(figure)](const Sources& sources) {
        Chart chart{.x = figure.x_axis};
        chart.y = figure.counted ? ChartAxis{.name = "fraction of the " + figure.of, .plain = "fraction of the " + figure.of}
                                 : ChartAxis{.name = "probability density", .plain = "probability density"};
        chart.y.from_zero = true;
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const FigureSource& source : sources) {
            for (const double number : source.numbers(figure.path)) {
                low = std::isfinite(number) ? std::min(low, number) : low;
                high = std::isfinite(number) ? std::max(high, number) : high;
            }
            chart.x.unit = source.unit(figure.path);
        }
        for (std::size_t k = 0; k < sources.size(); ++k) {
            Series series{
                .name = legend_name(sources, k), .mark = figure.counted ? Mark::bars : Mark::line, .colour = static_cast<int>(k)};
            if (figure.counted) {
                add_counts(series, sources[k].numbers(figure.path));
            } else {
                add_density(series, sources[k].numbers(figure.path), low, high, figure.bins);
            }
            chart.series.push_back(std::move(series));
        }
        return Drawing{.panels = {chart}, .caption = figure.caption};
    };
}

}  // namespace coagula::report
