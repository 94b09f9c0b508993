// SPDX-License-Identifier: GPL-3.0-or-later
// Charts for a paper: series of numbers over axes with units, drawn by gnuplot as SVG, PNG or PDF.
#pragma once

#include <coagula/common/checks.hpp>

#include <string>
#include <utility>
#include <vector>

namespace coagula::report {

/// How a series is shown.
enum class Mark {
    line,
    dashed_line,
    points,       ///< filled
    open_points,  ///< for what somebody else found, or the second of two quantities
    line_points,
    open_line_points,
    bars,   ///< from zero, beside those of the other series
    discs,  ///< to scale, with `radius` and `rgb`, in the order in which they are painted
    arrow,  ///< from the first place to the second
};

/// Places of one kind, in the unit of the data. A place with a coordinate that is not finite, or not above zero on a logarithmic
/// axis, is left out.
struct Series {
    std::string name = {};  ///< in the legend as it stands; empty: not there
    std::vector<double> x = {};
    std::vector<double> y = {};
    std::vector<double> error = {};  ///< half the length of the bar at each point; empty: no bars
    Mark mark = Mark::line;
    int colour = 0;                   ///< number in the palette; series of one file share it. -1: black
    bool second_axis = false;         ///< y belongs to the axis at the right
    std::vector<double> radius = {};  ///< of discs, in the unit of x
    std::vector<int> rgb = {};        ///< of discs, red in the highest byte
    bool key_only = false;            ///< an entry of the legend for a kind of line that all files have; it has no places
    bool per_structure = false;       ///< one place per structure, so that mean and standard error over structures mean something
};

/// What an axis shows. `name` may carry gnuplot's markup and is never what a user wrote.
struct ChartAxis {
    std::string name = {};   ///< such as "shear modulus {/:Italic G}'"
    std::string plain = {};  ///< the same without markup, for tables
    std::string unit = "1";  ///< of the data, as in a file; lengths and pressures are shown with the prefix that fits
    bool logarithmic = false;
    bool from_zero = false;  ///< a linear axis begins at zero
    double low = unset;      ///< ends in the unit of the data; unset: from the data
    double high = unset;
};

/// Where the legend stands. More than four entries always stand above the chart.
enum class Legend { top_right, top_left, bottom_right, bottom_left };

struct Chart {
    ChartAxis x = {};
    ChartAxis y = {};
    ChartAxis second_y = {};  ///< used when a series needs it
    std::vector<Series> series = {};
    Legend legend = Legend::top_right;
    std::vector<std::string> notes = {};  ///< lines in the corner opposite to the legend, as they stand
    bool picture = false;                 ///< without axes, both directions to one scale
};

/// One to three charts side by side, and what a reader must know to read them.
struct Drawing {
    std::vector<Chart> panels;
    std::string caption;
};

enum class PictureFormat { svg, png, pdf };

struct PictureSize {
    double width = 0.085;        ///< [m]
    double height = 0.064;       ///< [m]
    int resolution = 300;        ///< of PNG, dots per inch
    std::string font = "Arial";  ///< letters, digits, blanks and hyphens
    double font_size = 8;        ///< of the labels of the axes [pt]; numbers and legends are an eighth smaller
};

/// Width of a column and of a page, in the shape that suits the number of panels.
PictureSize default_size(const Drawing& drawing);

/// The format that the ending .svg, .png or .pdf names. Throws InputError for another ending.
/// @param option that gave the name, such as "--output".
PictureFormat picture_format(const std::string& path, const std::string& option);

/// Indices of the places of a series that can be shown.
std::vector<std::size_t> shown_places(const Chart& chart, const Series& series);

/// Number of values below zero that a logarithmic axis cannot show.
std::size_t values_below_axis(const Drawing& drawing);

/// The picture as the bytes of a file. Nothing of a series reaches gnuplot but numbers and quoted names. Throws InputError when a
/// series has no place that can be shown and std::runtime_error when gnuplot is missing or fails.
std::string draw(const Drawing& drawing, PictureFormat format, const PictureSize& size);

/// The commands that draw it, without the terminal.
std::string gnuplot_commands(const Drawing& drawing, const PictureSize& size = {});

/// Rows of a table of all series: a head, then panel, series, x, y and error of each place shown, in the unit of the data.
std::vector<std::vector<std::string>> chart_rows(const Drawing& drawing);

}  // namespace coagula::report
