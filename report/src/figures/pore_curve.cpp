// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_parts.hpp"

#include <cmath>

namespace coagula::report {

namespace {

const std::string group = "/characterization/";

Series in_radii(const FigureSource& source, const std::string& path, double r0) {
    Series series;
    series.x = source.numbers(group + "pore_curve/radius");
    series.y = source.numbers(path);
    for (double& radius : series.x) {
        radius /= r0;
    }
    return series;
}

/// What tells the structures apart in one number.
std::string name_of(const Sources& sources, std::size_t k) {
    const std::string name = legend_name(sources, k);
    const std::string a = "a = " + with_digits(sources[k].number(group + "doh/a"), 3);
    return name.empty() ? "exact, " + a : name + ", " + a;
}

}  // namespace

Drawing draw_pore_curve(const Sources& sources) {
    Chart chart{.x = {.name = "pore radius {/:Italic r} / {/:Italic r}_0", .plain = "pore radius over r0", .from_zero = true},
                .y = {.name = "probability {/:Italic P}({/:Italic r}_P > {/:Italic r})",
                      .plain = "probability of a larger pore radius",
                      .from_zero = true}};
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const double r0 = sources[k].number(group + "mean_radius");
        Series exact = in_radii(sources[k], group + "pore_curve/exclusion_probability", r0);
        exact.name = name_of(sources, k);
        exact.colour = static_cast<int>(k);
        chart.series.push_back(exact);
    }
    for (std::size_t k = 0; k < sources.size(); ++k) {
        Series fit = in_radii(sources[k], group + "pore_curve/fit", sources[k].number(group + "mean_radius"));
        fit.name = k > 0 ? "" : sources.size() > 1 ? "fit" : "1 − erf[(r/r0 − b) / (a√2)]";
        fit.mark = Mark::dashed_line;
        fit.colour = -1;
        chart.series.push_back(fit);
    }
    return {.panels = {chart},
            .caption =
                "Probability that a point of the pore space is farther than r from every sphere. Solid: exact, from the union of "
                "balls cut along the Voronoi cells. Dashed: the fitted error function, whose width a is the degree of "
                "heterogeneity."};
}

}  // namespace coagula::report
