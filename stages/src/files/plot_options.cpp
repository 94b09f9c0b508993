// SPDX-License-Identifier: GPL-3.0-or-later
// The options of plot.
#include <coagula/report/figures.hpp>
#include <coagula/stages/files.hpp>

namespace coagula::stages {

namespace {

constexpr Range picture_length{0.02, 0.5};  // m

}  // namespace

Verb plot_verb() {
    std::vector<std::string> names;
    std::vector<std::string> notes;
    for (const report::Figure& figure : report::figures()) {
        std::string line = "  " + figure.name;
        line.resize(30, ' ');
        names.push_back(figure.name);
        notes.push_back(line + figure.meaning);
    }
    notes.insert(notes.begin(), "Figures (docs/figures.md shows them):");
    notes.insert(notes.end(), {"Several files are drawn in one figure. A folder stands for all .h5 and .csv files in it.",
                               "--paper draws figures 1 - 6 of Schenker et al. 2012 into the folder that --output names."});
    Verb verb{
        .name = "plot",
        .summary = "a figure of result files for a paper, as SVG, PNG or PDF",
        .input = "FILE ...",
        .options = {choice("figure", names, "name of the figure, see below", ""),
                    text("x", "COLUMN", "of a data set: column on the x axis, such as doh.a"),
                    text("y", "COLUMN", "of a data set: column on the y axis"),
                    text("colour", "COLUMN", "of a data set: one series for each value of this column"),
                    text("facet", "COLUMN", "of a data set: one chart for each value of this column, of which there may be three"),
                    flag("paper", "draw the figures of Schenker et al. 2012 with their published points"),
                    required(output("picture, its format by the ending .svg, .png or .pdf; a folder with --paper")),
                    text("labels", "LIST",
                         "names of the files in the legend, such as 'slow,fast'; files with the same name form one series"),
                    flag("published", "add the published points, where there are some"),
                    choice("log", {"none", "x", "y", "xy"}, "logarithmic axes; those of the figure when not given", ""),
                    text("x-range", "LOW:HIGH", "ends of the x axis, such as 0.1Hz:100Hz or 0: ; those of the data when not given"),
                    text("y-range", "LOW:HIGH", "ends of the y axis, likewise"),
                    text("font", "NAME", "font of the text", "Arial"),
                    quantity("size", "1", "size of the text in points", "8", within(4, 40)),
                    quantity("width", "m", "width of the picture; 85mm, or 170mm for two charts, when not given", "",
                             picture_length),
                    quantity("height", "m", "height of the picture; in proportion to the width when not given", "", picture_length),
                    count("resolution", "resolution of a PNG in dots per inch", "300", within(50, 1200)),
                    writes(text("data", "FILE", "write the plotted numbers to this file as CSV")),
                    choice("format", {"svg", "png", "pdf"}, "with --paper: format of the pictures", "svg"),
                    flag("force", "replace existing output files")},
        .notes = notes,
        .many_inputs = true};
    read_only_with(verb.options, {"format"}, "paper");
    read_only_with(verb.options, {"colour", "facet"}, "x");
    not_read_with(verb.options, {"x", "y"}, "figure");
    not_read_with(verb.options, {"x", "y"}, "paper");
    not_read_with(verb.options, {"published", "labels"}, "x");
    return verb;
}

}  // namespace coagula::stages
