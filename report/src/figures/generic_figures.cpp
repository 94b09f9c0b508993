// Figures that need no code of their own: a curve of two data sets, a histogram of one.
#include "figure_parts.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::report {

namespace {

void check_lengths(const FigureSource& source, const std::string& x_path, std::size_t x, const std::string& y_path, std::size_t y) {
    if (x != y) {
        throw InputError(source.file + ": " + x_path + " has " + std::to_string(x) + " numbers and " + y_path + " " +
                         std::to_string(y) + ": a curve needs as many of both");
    }
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
        for (std::size_t k = 0; k < sources.size(); ++k) {
            const FigureSource& source = sources[k];
            Series series{.name = legend_name(sources, k), .mark = figure.mark, .colour = static_cast<int>(k)};
            series.x = source.numbers(figure.x);
            series.y = source.numbers(figure.y);
            check_lengths(source, figure.x, series.x.size(), figure.y, series.y.size());
            if (!figure.y_error.empty()) {
                series.error = source.numbers(figure.y_error);
                check_lengths(source, figure.x, series.x.size(), figure.y_error, series.error.size());
            }
            chart.x.unit = source.unit(figure.x);
            chart.y.unit = source.unit(figure.y);
            chart.series.push_back(std::move(series));
        }
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
