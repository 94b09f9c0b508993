// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/chart.hpp>

#include <coagula/io/printable.hpp>
#include <coagula/report/gnuplot.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace coagula::report {

namespace {

constexpr double inch = 0.0254;  // m
constexpr double point = inch / 72;

/// Throws InputError for a name that is none of a font.
std::string font_of(const PictureSize& size) {
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == ' ' || c == '-' || c >= 0x80; };
    if (size.font.empty() || !std::all_of(size.font.begin(), size.font.end(), fits)) {
        throw InputError("--font: '" + io::printable(size.font) +
                         "' is no name of a font; it may have letters, digits, blanks and hyphens");
    }
    return "font '" + size.font + "," + to_text(size.font_size) + "'";
}

std::string pair_text(double first, double second, const std::string& unit) {
    return to_text(first) + unit + "," + to_text(second) + unit;
}

/// gnuplot counts PNG in pixels: 8 points at 300 dots per inch are 33 of them. Its terminals on Cairo take a point for 4/3 of a
/// unit.
std::string terminal(PictureFormat format, const PictureSize& size) {
    const std::string font = font_of(size);
    if (format == PictureFormat::svg) {
        return "set terminal svg enhanced fixed size " + pair_text(size.width / point, size.height / point, "") + " " + font +
               " linewidth 0.7 background rgb 'white'\n";
    }
    if (format == PictureFormat::pdf) {
        return "set terminal pdfcairo enhanced size " + pair_text(100 * size.width, 100 * size.height, "cm") + " " + font +
               " fontscale 0.75 linewidth 1.3 rounded\n";
    }
    const double dots = size.resolution / 72.0;
    return "set terminal pngcairo enhanced size " +
           pair_text(std::round(size.width / inch * size.resolution), std::round(size.height / inch * size.resolution), "") + " " +
           font + " fontscale " + to_text(0.75 * dots) + " linewidth " + to_text(0.7 * dots) + " pointscale " + to_text(dots) +
           " background rgb 'white' rounded\n";
}

/// The size on paper, and fonts that a machine without Arial has.
std::string finished_svg(std::string svg, const PictureSize& size) {
    const std::size_t begin = svg.find("<svg");
    const std::size_t width = svg.find("width=\"", begin);
    const std::size_t end = svg.find('\n', width);
    const std::size_t box = svg.find("viewBox", begin);
    if (width < box && end < box && box != std::string::npos) {
        svg.replace(width, box - width,
                    "width=\"" + to_text(1000 * size.width) + "mm\" height=\"" + to_text(1000 * size.height) + "mm\"\n ");
    }
    const std::string face = "font-family=\"" + size.font + "\"";
    const std::string faces = "font-family=\"" + size.font + (size.font == "Arial" ? "" : ", Arial") + ", Helvetica, sans-serif\"";
    for (std::size_t place = 0; (place = svg.find(face, place)) != std::string::npos; place += faces.size()) {
        svg.replace(place, face.size(), faces);
    }
    return without_names(std::move(svg));
}

bool is_shown(const Chart& chart, const Series& series) {
    return series.mark == Mark::arrow || !shown_places(chart, series).empty();
}

std::string column_name(const ChartAxis& axis) {
    return axis.plain + (axis.unit == "1" ? "" : " [" + axis.unit + "]");
}

}  // namespace

PictureSize default_size(const Drawing& drawing) {
    PictureSize size;
    if (drawing.panels.size() > 1) {
        size.width = 0.17;
    }
    if (drawing.panels.size() == 1 && drawing.panels.front().picture) {
        size.height = size.width;
    }
    for (const Chart& chart : drawing.panels) {
        const auto entries =
            std::count_if(chart.series.begin(), chart.series.end(), [](const Series& series) { return !series.name.empty(); });
        if (entries > 4) {  // the legend stands above the chart
            size.height = std::max(size.height, 0.064 + 0.0017 * static_cast<double>(entries));
        }
    }
    return size;
}

PictureFormat picture_format(const std::string& path, const std::string& option) {
    for (const auto& [ending, format] :
         {std::pair(".svg", PictureFormat::svg), std::pair(".png", PictureFormat::png), std::pair(".pdf", PictureFormat::pdf)}) {
        if (path.ends_with(ending)) {
            return format;
        }
    }
    throw InputError(option + ": " + path + " must end in .svg, .png or .pdf");
}

std::string draw(const Drawing& drawing, PictureFormat format, const PictureSize& size) {
    for (const Chart& chart : drawing.panels) {
        if (std::none_of(chart.series.begin(), chart.series.end(), [&](const Series& s) { return is_shown(chart, s); })) {
            throw InputError("there is nothing to draw: no value of " + chart.y.plain + " against " + chart.x.plain +
                             " is a number" +
                             (chart.x.logarithmic || chart.y.logarithmic ? " above zero, as a logarithmic axis needs" : ""));
        }
    }
    const GnuplotOutput output = run_gnuplot(terminal(format, size) + gnuplot_commands(drawing, size) + "unset output\n");
    if (!output.problem.empty()) {
        throw std::runtime_error("the picture is not drawn: " + output.problem);
    }
    return format == PictureFormat::svg ? finished_svg(output.picture, size) : output.picture;
}

std::vector<std::vector<std::string>> chart_rows(const Drawing& drawing) {
    std::vector<std::vector<std::string>> rows;
    for (const Chart& chart : drawing.panels) {
        for (const Series& series : chart.series) {
            if (series.mark == Mark::discs || series.mark == Mark::arrow || series.key_only) {
                continue;
            }
            const ChartAxis& y = series.second_axis ? chart.second_y : chart.y;
            for (const std::size_t k : shown_places(chart, series)) {
                rows.push_back({series.name, column_name(chart.x), to_text(series.x[k]), column_name(y), to_text(series.y[k]),
                                series.error.empty() || !std::isfinite(series.error[k]) ? "" : to_text(series.error[k])});
            }
        }
    }
    rows.insert(rows.begin(), {"series", "x is", "x", "y is", "y", "error of y"});
    return rows;
}

}  // namespace coagula::report
