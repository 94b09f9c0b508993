// SPDX-License-Identifier: GPL-3.0-or-later
// The modulus against the stiffness of the particles, from the table of coagula calibrate.
#include "figure_parts.hpp"

#include <coagula/io/table.hpp>

#include <filesystem>

namespace coagula::report {

namespace {

/// The series of one table, one per structure.
std::vector<Series> stiffness_series(const FigureSource& source) {
    const std::vector<std::string> structures = io::read_text_column(source.file, "structure");
    const std::vector<Eigen::VectorXd> columns = io::read_table(source.file, {{.name = "normal stiffness", .unit = "N/m"},
                                                                              {.name = "modulus", .unit = "Pa"},
                                                                              {.name = "standard deviation", .unit = "Pa"}});
    std::vector<Series> series;
    for (std::size_t row = 0; row < structures.size(); ++row) {
        if (row == 0 || structures[row] != structures[row - 1]) {
            series.push_back({.name = std::filesystem::path(structures[row]).stem().string(), .mark = Mark::points});
        }
        const auto k = static_cast<Index>(row);
        series.back().x.push_back(columns[0][k]);
        series.back().y.push_back(columns[1][k]);
        series.back().error.push_back(columns[2][k]);
    }
    return series;
}

/// The straight line through the origin and the last place: linear springs in a fixed ratio have it.
Series proportional_line(const Series& series) {
    return {.x = {0, series.x.back()}, .y = {0, series.y.back()}, .mark = Mark::dashed_line, .colour = series.colour};
}

}  // namespace

Drawing draw_modulus_stiffness(const Sources& sources) {
    Chart chart{.x = {.name = "normal particle stiffness {/:Italic k}_n",
                      .plain = "normal particle stiffness",
                      .unit = "N/m",
                      .from_zero = true},
                .y = modulus_axis_of("shear modulus {/:Italic G}′", "shear modulus"),
                .legend = Legend::top_left};
    int structures = 0;
    for (const FigureSource& source : sources) {
        if (source.contents) {
            throw InputError(source.file + " is a structure, but this figure is drawn from the table that 'coagula calibrate " +
                             source.file + " -o series.csv' writes");
        }
        for (Series& series : stiffness_series(source)) {
            series.colour = structures++;
            chart.series.push_back(proportional_line(series));
            chart.series.push_back(std::move(series));
        }
    }
    return {.panels = {chart},
            .caption =
                "Simulated shear modulus G' against the normal stiffness k_n of the particles. The bars are the standard deviation "
                "over six orientations. Dashed: proportional to k_n."};
}

std::vector<Series> published_modulus_stiffness() {
    Series least{.name = "published BD, 0 mV", .mark = Mark::open_points, .colour = 0};
    Series most{.name = "published BD, 15 mV", .mark = Mark::open_points, .colour = 1};
    for (const PublishedStructure& row : published_structures()) {
        if (row.generator == "brownian" && (row.parameter == 0 || row.parameter == 15)) {
            Series& series = row.parameter == 0 ? least : most;
            series.x.push_back(100);  // N/m, of all moduli in table 2
            series.y.push_back(row.modulus);
            series.error.push_back(row.spread);
        }
    }
    return {least, most};
}

}  // namespace coagula::report
