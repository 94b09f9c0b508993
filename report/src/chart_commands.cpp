// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_axis.hpp"
#include "chart_legend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

/// Colours of Okabe and Ito (2008), which people who cannot tell red from green tell apart.
constexpr std::array palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"};
constexpr std::array filled = {7, 5, 9, 13, 11};  // circle, square, triangle, diamond, triangle
constexpr std::array hollow = {6, 4, 8, 12, 10};
constexpr double bar_share = 0.8;  // of the distance between neighbours

std::string style(const PictureSize& size) {
    return "set encoding utf8\nset border 15 linewidth 0.8\nset tics in scale 0.7,0.35 font '," + to_text(small_font(size)) +
           "'\nset mxtics 2\nset mytics 2\nset style fill solid 1.0 noborder\n";
}

std::size_t number_of(int colour, std::size_t count) {
    return static_cast<std::size_t>(std::max(colour, 0)) % count;
}

std::string colour_of(const Series& series) {
    return std::string("linecolor rgb '") + (series.colour < 0 ? "#000000" : palette.at(number_of(series.colour, palette.size()))) +
           "'";
}

std::string point_of(const Series& series, bool open) {
    const auto& kinds = open ? hollow : filled;
    return " pointtype " + std::to_string(kinds.at(number_of(series.colour, kinds.size()))) + " pointsize 0.55";
}

bool is_bar(const Series& series) {
    return series.mark == Mark::bars;
}

/// Smallest distance between neighbouring bars.
double bar_distance(const Chart& chart) {
    double distance = std::numeric_limits<double>::infinity();
    for (const Series& series : chart.series) {
        for (std::size_t k = 1; is_bar(series) && k < series.x.size(); ++k) {
            distance = std::min(distance, std::abs(series.x[k] - series.x[k - 1]));
        }
    }
    return std::isfinite(distance) && distance > 0 ? distance : 1;
}

ChartAxes settle_axes(const Chart& chart) {
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> second;
    const double beside = bar_distance(chart) / 2;
    for (const Series& series : chart.series) {
        std::vector<double>& other = series.second_axis ? second : y;
        for (const std::size_t k : shown_places(chart, series)) {
            const double bar = series.error.empty() || !std::isfinite(series.error[k]) ? 0 : series.error[k];
            const double reach = is_bar(series) ? beside : series.radius.empty() ? 0 : series.radius[k];
            x.insert(x.end(), {series.x[k] - reach, series.x[k] + reach});
            other.insert(other.end(), {series.y[k] - bar, series.y[k] + bar});
            if (is_bar(series)) {
                other.push_back(0);
            }
        }
    }
    ChartAxes axes{settle(chart.x, x), settle(chart.y, y), settle(chart.second_y, second), !second.empty()};
    const bool powers = wants_powers(axes.x) || wants_powers(axes.y) || (axes.has_second && wants_powers(axes.second));
    axes.x.powers = axes.y.powers = axes.second.powers = powers;  // the numbers of all axes are written alike
    return axes;
}

/// The numbers of a series as a data block of gnuplot.
std::string block_of(const Chart& chart, const ChartAxes& axes, const Series& series, const std::string& name, double shift,
                     double width) {
    const double y_scale = series.second_axis ? axes.second.scale : axes.y.scale;
    std::string block = name + " << EOD\n";
    for (const std::size_t k : shown_places(chart, series)) {
        block += to_text((series.x[k] + shift) / axes.x.scale) + ' ' + to_text(series.y[k] / y_scale);
        if (series.mark == Mark::discs) {
            block += ' ' + to_text(series.radius[k] / axes.x.scale) + ' ' + std::to_string(series.rgb[k]);
        } else if (is_bar(series)) {
            block += ' ' + to_text(width / axes.x.scale);
        } else if (!series.error.empty()) {
            const SettledAxis& axis = series.second_axis ? axes.second : axes.y;
            const double bar = std::isfinite(series.error[k]) ? series.error[k] / y_scale : 0;
            const double low = std::max(series.y[k] / y_scale - bar, axis.low);
            block += ' ' + to_text(low) + ' ' + to_text(series.y[k] / y_scale + bar - low);
        }
        block += '\n';
    }
    return block + "EOD\n";
}

std::string arrow_command(const ChartAxes& axes, const Series& series, std::size_t number) {
    const auto place = [&](std::size_t k) {
        return to_text(series.x.at(k) / axes.x.scale) + "," + to_text(series.y.at(k) / axes.y.scale);
    };
    return "set arrow " + std::to_string(number + 1) + " from " + place(0) + " to " + place(1) + " " + colour_of(series) +
           " linewidth 1.5 front\n";
}

std::string look_of(const Series& series) {
    const std::string colour = colour_of(series);
    switch (series.mark) {
        case Mark::line:
            return "with lines linewidth 1.6 " + colour;
        case Mark::dashed_line:
            return "with lines linewidth 1.2 dashtype (16,10) " + colour;
        case Mark::points:
        case Mark::open_points:
            return "with points linewidth 1 " + colour + point_of(series, series.mark == Mark::open_points);
        case Mark::line_points:
        case Mark::open_line_points:
            return "with linespoints linewidth 1 " + colour + point_of(series, series.mark == Mark::open_line_points);
        case Mark::bars:
            return "with boxes " + colour;
        case Mark::discs:
            return "with circles linecolor rgb variable";
        case Mark::arrow:
            break;
    }
    return {};
}

std::string title_of(const std::string& name) {
    return name.empty() ? " notitle" : " title (" + quoted_text(name) + ") noenhanced";
}

/// The plot of one series, its error bars below its points. @param name as the legend has it.
std::string plot_of(const Series& series, const std::string& name, const std::string& block) {
    const std::string axis = series.second_axis ? " axes x1y2" : "";
    const std::string columns = series.mark == Mark::discs ? "1:2:3:4" : is_bar(series) ? "1:2:3" : "1:2";
    std::string plot;
    if (!series.error.empty() && !is_bar(series)) {  // gnuplot's own bars leave a gap around the point
        plot = block + " using 1:3:(0):4" + axis + " with vectors heads size graph 0.008,90 linewidth 0.8 " + colour_of(series) +
               " notitle, ";
    }
    return plot + block + " using " + columns + axis + " " + look_of(series) + title_of(name);
}

/// Lines below the legend's corner: at the same side, in the other half.
std::string note_commands(const Chart& chart, const PictureSize& size) {
    std::string commands;
    for (std::size_t k = 0; k < chart.notes.size(); ++k) {
        commands += "set label " + std::to_string(k + 1) + " (" + quoted_text(chart.notes[k]) + ")" + " at graph 0.96, graph " +
                    to_text(0.62 - 0.075 * static_cast<double>(k)) + " right noenhanced font '," + to_text(small_font(size)) +
                    "' front\n";
    }
    return commands;
}

std::string frame_commands(const Chart& chart, const ChartAxes& axes, const PictureSize& size) {
    std::string commands = "reset\n" + style(size) + axis_commands(axes.x, "x") + axis_commands(axes.y, "y");
    if (chart.picture) {
        return commands + "set size ratio -1\nunset border\nunset tics\nunset xlabel\nunset ylabel\nset margins 0,0,0,0\n";
    }
    if (axes.has_second) {
        commands += "set ytics nomirror\nset y2tics\nset my2tics 2\n" + axis_commands(axes.second, "y2");
    }
    return commands;
}

/// @param panels beside each other in the picture.
std::string chart_commands(const Chart& chart, const PictureSize& size, std::size_t panels) {
    ChartAxes axes = settle_axes(chart);
    const Frame frame = frame_of(size, panels);
    const std::string legend = place_legend(chart, axes, frame);
    const auto bars = static_cast<double>(std::count_if(chart.series.begin(), chart.series.end(), is_bar));
    const double width = bar_share * bar_distance(chart) / std::max(bars, 1.0);
    double bar = 0;
    std::string commands = frame_commands(chart, axes, size) + legend + note_commands(chart, size);
    std::string plots;
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
        const Series& series = chart.series[k];
        if (series.mark == Mark::arrow) {
            commands += arrow_command(axes, series, k);
            continue;
        }
        const std::string name = fitted_name(series.name, frame);
        if (series.key_only) {
            plots += (plots.empty() ? "plot NaN " : ", NaN ") + look_of(series) + title_of(name);
            continue;
        }
        if (shown_places(chart, series).empty()) {
            continue;
        }
        const std::string block = "$series" + std::to_string(k);
        const double shift = is_bar(series) ? (bar++ - (bars - 1) / 2) * width : 0;
        commands += block_of(chart, axes, series, block, shift, width);
        plots += (plots.empty() ? "plot " : ", ") + plot_of(series, name, block);
    }
    return commands + plots + "\n";
}

}  // namespace

std::vector<std::size_t> shown_places(const Chart& chart, const Series& series) {
    const auto can = [](const ChartAxis& axis, double value) { return std::isfinite(value) && (!axis.logarithmic || value > 0); };
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
        if (can(chart.x, series.x[k]) && can(series.second_axis ? chart.second_y : chart.y, series.y[k])) {
            places.push_back(k);
        }
    }
    return places;
}

std::size_t values_below_axis(const Drawing& drawing) {
    std::size_t count = 0;
    for (const Chart& chart : drawing.panels) {
        for (const Series& series : chart.series) {
            const ChartAxis& y = series.second_axis ? chart.second_y : chart.y;
            const bool shows_numbers = series.mark != Mark::discs && series.mark != Mark::arrow && !series.key_only;
            for (std::size_t k = 0; shows_numbers && k < std::min(series.x.size(), series.y.size()); ++k) {
                count += (y.logarithmic && series.y[k] < 0) || (chart.x.logarithmic && series.x[k] < 0) ? 1 : 0;
            }
        }
    }
    return count;
}

std::string gnuplot_commands(const Drawing& drawing, const PictureSize& size) {
    std::string commands = "set multiplot layout 1," + std::to_string(drawing.panels.size()) + "\n";
    for (const Chart& chart : drawing.panels) {
        commands += chart_commands(chart, size, drawing.panels.size());
    }
    return commands + "unset multiplot\n";
}

}  // namespace coagula::report
