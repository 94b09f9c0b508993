// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

const std::string load_structure = "/mechanics/linear/load_structure/";
constexpr std::array planes = {"xy", "xz", "yz"};
constexpr double tail_begins = 2;  // in mean forces, as coagula shear fits it

/// Density over the planes that carry shear.
Series density_of(const FigureSource& source) {
    Series series{.mark = Mark::line_points};
    double carried = 0;
    for (const std::string plane : planes) {
        const std::string path = load_structure + plane + "/";
        const std::vector<double> density = source.numbers(path + "force_distribution/density");
        if (source.number(path + "carried") == 0) {
            continue;
        }
        ++carried;
        const double width = source.number(path + "force_distribution/bin_width");
        for (std::size_t k = series.x.size(); k < density.size(); ++k) {
            series.x.push_back((static_cast<double>(k) + 0.5) * width);
            series.y.push_back(0);
        }
        for (std::size_t k = 0; k < density.size(); ++k) {
            series.y[k] += density[k];
        }
    }
    for (double& density : series.y) {
        density /= carried;
    }
    if (carried == 0) {
        throw InputError(source.file + " carries no shear: there are no bond forces to draw");
    }
    return series;
}

/// Largest force that some bond has.
double last_filled(const Series& density) {
    double last = tail_begins;
    for (std::size_t k = 0; k < density.x.size(); ++k) {
        last = density.y[k] > 0 ? std::max(last, density.x[k]) : last;
    }
    return last;
}

/// The exponential through the forces beyond twice the mean, in the plane xy.
Series tail_of(const FigureSource& source, double end) {
    const std::string path = load_structure + "xy/force_distribution/";
    const double slope = source.number(path + "tail_slope");
    const double share = source.number(path + "tail_bonds") / std::max(1.0, source.number(path + "bonds"));
    Series series{.mark = Mark::dashed_line, .colour = -1};
    if (slope > 0 && share > 0) {
        series.x = {tail_begins, end};
        for (const double force : series.x) {
            series.y.push_back(share * slope * std::exp(-slope * (force - tail_begins)));
        }
    }
    return series;
}

}  // namespace

Drawing draw_bond_forces(const Sources& sources) {
    Chart chart{
        .x = {.name = "bond force |{/:Italic f}_n| / ⟨|{/:Italic f}_n|⟩", .plain = "normal force over its mean", .from_zero = true},
        .y = {.name = "probability density", .plain = "probability density", .logarithmic = true}};
    for (std::size_t k = 0; k < sources.size(); ++k) {
        Series density = density_of(sources[k]);
        density.name = legend_name(sources, k);
        density.colour = static_cast<int>(k);
        Series tail = tail_of(sources[k], last_filled(density));
        chart.series.push_back(std::move(density));
        if (sources.size() == 1 && !tail.x.empty()) {
            tail.name =
                "exp(−" + with_digits(sources[k].number(load_structure + "xy/force_distribution/tail_slope"), 3) + " f / ⟨f⟩)";
            chart.series.push_back(std::move(tail));
        }
    }
    return {.panels = {chart},
            .caption =
                "Distribution of the normal forces in the bonds under simple shear, in units of their mean; average of the planes "
                "xy, xz and yz. Dashed: the exponential fitted to the forces beyond twice the mean (plane xy)."};
}

}  // namespace coagula::report
