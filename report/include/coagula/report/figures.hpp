// SPDX-License-Identifier: GPL-3.0-or-later
// The figures that can be drawn from result files: one table, to which a measure adds its figure by one line.
#pragma once

#include <coagula/io/structure_file.hpp>
#include <coagula/report/chart.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace coagula::report {

/// A file that a figure is drawn from: a structure with results, or a table.
struct FigureSource {
    std::string file;
    std::string label;                          ///< in the legend
    bool labelled = false;                      ///< by the user, not by the name of the file
    std::optional<io::Contents> contents = {};  ///< empty for a table (.csv)

    /// The data set at this path, or nothing.
    const io::Dataset* find(const std::string& path) const;
    /// Its numbers. Throws InputError that names the file, what is missing and the command that computes it.
    std::vector<double> numbers(const std::string& path) const;
    double number(const std::string& path) const;
    /// The unit of a data set that is there.
    const std::string& unit(const std::string& path) const;
    /// What a user runs to get the results at this path.
    std::string command_for(const std::string& path) const;
    /// Throws InputError for a table.
    const io::Contents& structure() const;
};

/// Reads a structure, or takes a table by its ending .csv. Throws as io::read_contents does.
/// @param label for the legend; empty: the name of the file without folder and ending.
FigureSource read_figure_source(const std::string& file, const std::string& label);

/// What a figure is drawn from.
enum class FigureInput { structures, tables, both };

struct Figure {
    std::string name;     ///< as --figure names it
    std::string meaning;  ///< one line for the help text
    std::function<Drawing(const std::vector<FigureSource>&)> draw;
    std::vector<Series> (*published)() = nullptr;  ///< points of Schenker et al. 2012 that belong beside it; null: none as numbers
    bool one_file = false;                         ///< it shows one file only
    FigureInput input = FigureInput::structures;
};

/// All of them, in the order of the help text.
const std::vector<Figure>& figures();

/// Throws InputError that lists the names.
const Figure& figure_named(const std::string& name);

/// The figure of these files. Throws InputError when results are missing, naming the command that computes them, when the figure
/// shows one file and there are several, and for published points that there are not.
/// @param published with the points of Schenker et al. 2012 beside.
Drawing draw_figure(const Figure& figure, const std::vector<FigureSource>& sources, bool published);

/// A figure of Schenker et al. 2012, made of what is there.
struct PaperFigure {
    int number;
    std::string figure;                     ///< name in the table
    std::optional<Drawing> drawing = {};    ///< nothing when results are missing
    std::vector<std::string> missing = {};  ///< sentences: what is missing and the command that makes it
};

/// Figures 1 to 6 from all files that have what the figure shows.
std::vector<PaperFigure> draw_paper_figures(const std::vector<FigureSource>& sources);

/// A curve of two data sets of equal length, one series per file, and a second one beside. The axes take their units from the file.
struct CurveFigure {
    std::string x;  ///< path of the abscissae, such as "/characterization/pair_correlation/distance"
    std::string y;
    ChartAxis x_axis;
    ChartAxis y_axis;
    std::string caption;
    Mark mark = Mark::line;
    Legend legend = Legend::top_right;
    std::string y_error = {};  ///< path of the error of y; empty or not in the file: none
    std::string other = {};    ///< path of a second y, dashed, such as a fit; empty or not in the file: none
    std::string other_name = {};
    std::string name = {};  ///< of y in the legend, where there is a second one
};
std::function<Drawing(const std::vector<FigureSource>&)> curve(CurveFigure figure);

/// A histogram: one data set of counts, or of numbers to be counted.
struct HistogramFigure {
    std::string path;  ///< counts of 0, 1, 2 ... (whole numbers), or one number per object, which is sorted into bins
    ChartAxis x_axis;
    std::string of;  ///< what is counted, such as "particles"
    std::string caption;
    bool counted = true;  ///< the data set holds counts
    int bins = 40;        ///< where numbers are sorted
};
std::function<Drawing(const std::vector<FigureSource>&)> histogram(HistogramFigure figure);

}  // namespace coagula::report
