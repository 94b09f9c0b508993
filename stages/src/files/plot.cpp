// SPDX-License-Identifier: GPL-3.0-or-later
// plot: a figure of one or more result files, or the figures of the paper.
#include "plot_set.hpp"

#include <coagula/io/atomic_file.hpp>
#include <coagula/io/table.hpp>
#include <coagula/io/units.hpp>
#include <coagula/report/figures.hpp>
#include <coagula/report/result_folder.hpp>
#include <coagula/stages/files.hpp>
#include <coagula/stages/output_file.hpp>
#include <coagula/stages/over_structures.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;
using report::Chart;
using report::ChartAxis;
using report::Drawing;
using report::FigureSource;
using report::PictureFormat;
using report::PictureSize;
using report::Series;

/// A file to draw, named by the user or found in a folder that was.
struct InputFile {
    std::string path;
    bool named = true;
};

/// Files as given; of a folder its structures and tables.
std::vector<InputFile> files_of(const Arguments& arguments) {
    std::vector<InputFile> files;
    for (const std::string& input : arguments.inputs()) {
        if (!fs::is_directory(input)) {
            files.push_back({input});
            continue;
        }
        std::vector<std::string> inside;
        for (const fs::directory_entry& entry : fs::directory_iterator(input)) {
            const std::string ending = entry.path().extension().string();
            if (entry.is_regular_file() && (ending == ".h5" || ending == ".csv")) {
                inside.push_back(entry.path().string());
            }
        }
        if (inside.empty()) {
            throw InputError("the folder " + input + " holds no .h5 or .csv file to draw");
        }
        std::sort(inside.begin(), inside.end());
        std::transform(inside.begin(), inside.end(), std::back_inserter(files), [](const std::string& path) {
            return InputFile{path, false};
        });
    }
    return files;
}

std::vector<std::string> paths_of(const Arguments& arguments) {
    std::vector<std::string> paths;
    for (const InputFile& file : files_of(arguments)) {
        paths.push_back(file.path);
    }
    return paths;
}

/// What can be drawn, and a sentence about each file of a folder that is no structure, such as a checkpoint.
struct ReadSources {
    std::vector<FigureSource> sources;
    std::vector<std::string> skipped;
};

/// No labels, which takes the names of the files; of files with one name, their paths.
std::vector<std::string> labels_of(const std::vector<InputFile>& files) {
    std::map<fs::path, int> names;
    for (const InputFile& file : files) {
        ++names[fs::path(file.path).filename()];
    }
    std::vector<std::string> labels;
    for (const InputFile& file : files) {
        const fs::path path(file.path);
        labels.push_back(names[path.filename()] > 1 ? fs::path(path).replace_extension().string() : "");
    }
    return labels;
}

ReadSources read_sources(const Arguments& arguments) {
    const std::vector<InputFile> files = files_of(arguments);
    const std::vector<std::string> labels = arguments.has("labels") ? split(arguments.text("labels")) : labels_of(files);
    if (labels.size() != files.size()) {
        throw InputError(arguments.spelled("labels") + " has " + std::to_string(labels.size()) + " labels for " +
                         std::to_string(files.size()) + " files: each file needs one");
    }
    ReadSources found;
    for (std::size_t k = 0; k < files.size(); ++k) {
        try {
            found.sources.push_back(report::read_figure_source(files[k].path, labels[k]));
        } catch (const InputError& error) {
            if (files[k].named) {
                throw;
            }
            found.skipped.emplace_back(error.what());
        }
    }
    if (found.sources.empty()) {
        throw InputError(found.skipped.front());
    }
    return found;
}

void append_skipped(const std::vector<std::string>& skipped, Json& json, Table& table) {
    json["skipped"] = skipped;
    for (const std::string& sentence : skipped) {
        table.emplace_back("skipped", sentence);
    }
}

/// Only a PNG is made of dots.
void check_resolution(const Arguments& arguments, PictureFormat format) {
    if (arguments.given("resolution") && format != PictureFormat::png) {
        throw InputError(arguments.spelled("resolution") + " is read for a PNG only: a picture in SVG or PDF has no dots");
    }
}

PictureSize size_of(const Arguments& arguments, const Drawing& drawing) {
    PictureSize size = report::default_size(drawing);
    const double shape = size.height / size.width;
    size.width = arguments.optional_quantity("width").value_or(size.width);
    size.height = arguments.optional_quantity("height").value_or(arguments.has("width") ? shape * size.width : size.height);
    size.resolution = static_cast<int>(arguments.count("resolution"));
    size.font = arguments.text("font");
    size.font_size = arguments.quantity("size");
    return size;
}

/// Sets the ends "LOW:HIGH" of an axis; an end that is left out follows from the data.
void set_range(const std::string& text, ChartAxis& axis) {
    const std::size_t middle = text.find(':');
    if (middle == std::string::npos || text.size() == 1) {
        throw InputError("'" + text + "' is no range LOW:HIGH; one end may be left out, as in 0: or :5");
    }
    const std::string low = text.substr(0, middle);
    const std::string high = text.substr(middle + 1);
    axis.low = low.empty() ? axis.low : io::parse_quantity(low, axis.unit);
    axis.high = high.empty() ? axis.high : io::parse_quantity(high, axis.unit);
}

void set_ranges(const Arguments& arguments, Drawing& drawing) {
    for (const auto& [name, axis] : {std::pair("x-range", &Chart::x), std::pair("y-range", &Chart::y)}) {
        if (!arguments.has(name)) {
            continue;
        }
        if (drawing.panels.front().picture && drawing.panels.size() == 1) {
            throw InputError(arguments.spelled(name) + ": this figure has no axes");
        }
        for (Chart& chart : drawing.panels) {
            if (!chart.picture) {
                arguments.parsed(name, [&range = chart.*axis](const std::string& text) {
                    set_range(text, range);
                    return 0;
                });
            }
        }
    }
}

/// Which axes --log names; nothing when it is not given.
void set_logarithmic(const Arguments& arguments, Drawing& drawing) {
    if (!arguments.has("log")) {
        return;
    }
    const std::string& axes = arguments.text("log");
    for (Chart& chart : drawing.panels) {
        if (!chart.picture) {
            chart.x.logarithmic = axes.find('x') != std::string::npos;
            chart.y.logarithmic = axes.find('y') != std::string::npos;
        }
    }
}

Json axis_json(const ChartAxis& axis) {
    return {{"quantity", axis.plain}, {"unit", axis.unit}};
}

/// Mean over the structures of a series.
std::optional<MeanWithError> over_structures(const Series& series, const std::vector<double>& values) {
    const Eigen::VectorXd all = Eigen::VectorXd::Map(values.data(), static_cast<Index>(values.size()));
    return series.per_structure && all.size() > 0 && all.allFinite() ? std::optional(mean_and_standard_error(all)) : std::nullopt;
}

Json series_json(const Drawing& drawing) {
    Json list = Json::array();
    for (const Chart& chart : drawing.panels) {
        for (const Series& series : chart.series) {
            if (series.mark == report::Mark::arrow || series.key_only) {
                continue;
            }
            Json json = {{"name", series.name},
                         {"points", report::shown_places(chart, series).size()},
                         {"x", axis_json(chart.x)},
                         {"y", axis_json(series.second_axis ? chart.second_y : chart.y)}};
            if (const auto x = over_structures(series, series.x)) {
                json["x"]["over_structures"] = to_json(*x);
                json["y"]["over_structures"] = to_json(*over_structures(series, series.y));
            }
            list.push_back(std::move(json));
        }
    }
    return list;
}

void append_series(Table& table, const Drawing& drawing) {
    for (const Chart& chart : drawing.panels) {
        for (const Series& series : chart.series) {
            if (series.name.empty() || series.key_only) {
                continue;
            }
            table.emplace_back(series.name, std::to_string(report::shown_places(chart, series).size()) + " points");
            const auto mean = over_structures(series, series.y);
            if (mean && mean->count > 1) {
                table.emplace_back("  mean " + chart.y.plain, with_unit(mean->mean, chart.y.unit) + ", standard error " +
                                                                  with_unit(mean->standard_error, chart.y.unit) + " over " +
                                                                  std::to_string(mean->count) + " structures");
            }
        }
    }
}

/// Writes the picture and, with --data, its numbers.
Printed write_drawing(const Arguments& arguments, Drawing drawing, const std::string& name,
                      const std::vector<std::string>& skipped) {
    const std::string& path = arguments.text("output");
    set_logarithmic(arguments, drawing);
    set_ranges(arguments, drawing);
    const PictureSize size = size_of(arguments, drawing);
    const std::string picture = report::draw(drawing, report::picture_format(path, arguments.spelled("output")), size);
    if (arguments.has("data")) {
        io::write_rows(arguments.text("data"), report::chart_rows(drawing), arguments.flag("force"));
    }
    io::write_file(path, picture, arguments.flag("force"));

    Json json = {{"figure", name},
                 {"output", path},
                 {"width", size.width},
                 {"height", size.height},
                 {"series", series_json(drawing)},
                 {"caption", drawing.caption}};
    Table table{{"figure", name}};
    append_series(table, drawing);
    if (const std::size_t below = report::values_below_axis(drawing); below > 0) {
        json["below_axis"] = below;
        table.emplace_back("not drawn", std::to_string(below) + (below == 1 ? " value" : " values") +
                                            " below zero, which a logarithmic axis does not show; --log chooses the axes");
    }
    if (arguments.has("data")) {
        json["data"] = arguments.text("data");
        table.emplace_back("data written to", arguments.text("data"));
    }
    append_skipped(skipped, json, table);
    table.emplace_back("written to", path);
    return {std::move(json), std::move(table)};
}

Printed plot_figure(const Arguments& arguments) {
    const std::string& path = arguments.text("output");
    check_resolution(arguments, report::picture_format(path, arguments.spelled("output")));
    const bool of_set = arguments.has("x") || arguments.has("y");
    const std::vector<std::string> files = of_set ? arguments.inputs() : paths_of(arguments);
    check_output(arguments, path, files);
    if (arguments.has("data")) {
        check_output(arguments, arguments.text("data"), files);
    }
    if (of_set) {
        if (!arguments.has("x") || !arguments.has("y") || files.size() != 1) {
            throw InputError("a data set is drawn with " + arguments.spelled("x") + " and " + arguments.spelled("y") +
                             ", and by itself");
        }
        return write_drawing(arguments, drawing_of_set(arguments, io::read_set(files.front())), "columns", {});
    }
    const report::Figure& figure = report::figure_named(arguments.text("figure"));
    const ReadSources found = read_sources(arguments);
    return write_drawing(arguments, report::draw_figure(figure, found.sources, arguments.flag("published")), figure.name,
                         found.skipped);
}

/// What stands below the figures, and what is missing.
std::string captions_text(const std::vector<report::PaperFigure>& figures, const std::string& ending) {
    std::string text = "# Figures of Schenker, Filser, Hütter, Gauckler, Granular Matter 14 (2012) 333, computed\n";
    for (const report::PaperFigure& figure : figures) {
        const std::string name = "figure" + std::to_string(figure.number);
        text += "\n## Figure " + std::to_string(figure.number) + " (" + figure.figure + ")\n\n";
        text += figure.drawing ? "![](" + name + ending + ")\n\n" + figure.drawing->caption + "\n" : "Not drawn.\n";
        for (const std::string& sentence : figure.missing) {
            text += "\nMissing: " + sentence + ".\n";
        }
    }
    return text;
}

Printed plot_paper(const Arguments& arguments) {
    for (const char* name : {"figure", "data", "log", "published", "x-range", "y-range"}) {
        if (arguments.has(name)) {
            throw InputError(arguments.spelled("paper") + " and " + arguments.spelled(name) + " exclude each other: " +
                             arguments.spelled("paper") + " draws all figures with the published points and writes their data");
        }
    }
    const std::string ending = "." + arguments.text("format");
    const PictureFormat format = report::picture_format(ending, arguments.spelled("format"));
    check_resolution(arguments, format);
    std::vector<std::string> files;
    for (int figure = 1; figure <= 6; ++figure) {
        files.push_back("figure" + std::to_string(figure) + ending);
        files.push_back("figure" + std::to_string(figure) + ".csv");
    }
    report::ResultFolder folder(arguments.text("output"), "captions.md", files, arguments.flag("force"));
    for (const fs::path& output : folder.files()) {
        check_not_read(arguments, output.string(), paths_of(arguments));
    }
    const ReadSources found = read_sources(arguments);
    const std::vector<report::PaperFigure> figures = report::draw_paper_figures(found.sources);

    Json json = {{"output", arguments.text("output")}, {"figures", Json::array()}};
    Table table;
    std::string first_missing;
    for (const report::PaperFigure& figure : figures) {
        const std::string name = "figure" + std::to_string(figure.number);
        Json entry = {{"number", figure.number},
                      {"figure", figure.figure},
                      {"drawn", figure.drawing.has_value()},
                      {"missing", figure.missing}};
        if (figure.drawing) {
            folder.write(name + ending, report::draw(*figure.drawing, format, size_of(arguments, *figure.drawing)));
            folder.write(name + ".csv", io::csv_text(report::chart_rows(*figure.drawing)));
            entry["series"] = series_json(*figure.drawing);
            entry["caption"] = figure.drawing->caption;
            table.emplace_back("figure " + std::to_string(figure.number), figure.figure + ", written to " + name + ending);
        } else {
            folder.withdraw(name + ending);
            folder.withdraw(name + ".csv");
            table.emplace_back("figure " + std::to_string(figure.number), figure.figure + ", not drawn");
        }
        for (const std::string& sentence : figure.missing) {
            first_missing = first_missing.empty() ? sentence : first_missing;
            table.emplace_back("  missing", sentence);
        }
        json["figures"].push_back(std::move(entry));
    }
    if (std::none_of(figures.begin(), figures.end(), [](const auto& figure) { return figure.drawing.has_value(); })) {
        throw InputError("no figure of the paper can be drawn: " + first_missing);
    }
    folder.write("captions.md", captions_text(figures, ending));
    folder.publish();
    append_skipped(found.skipped, json, table);
    table.emplace_back("written to", arguments.text("output"));
    return {std::move(json), std::move(table)};
}

}  // namespace

Printed plot_files(const Arguments& arguments) {
    if (arguments.flag("paper")) {
        return plot_paper(arguments);
    }
    if (!arguments.has("figure") && !arguments.has("x") && !arguments.has("y")) {
        throw InputError(arguments.caller_of() + " needs " + arguments.spelled("figure") + " NAME, or " +
                         arguments.spelled("paper") + " for those of the paper" + arguments.hint());
    }
    return plot_figure(arguments);
}

}  // namespace coagula::stages
