// SPDX-License-Identifier: GPL-3.0-or-later
// The table of figures.
#include "figure_parts.hpp"

#include <algorithm>

namespace coagula::report {

namespace {

std::vector<Figure> make_table() {
    std::vector<Figure> all = measure_figures();
    const std::vector<Figure> others = {
        {.name = "bond-forces", .meaning = "distribution of the bond forces under shear", .draw = draw_bond_forces},
        {.name = "frequency", .meaning = "G' and G'' against frequency", .draw = draw_frequency_response},
        {.name = "amplitude", .meaning = "G' and G'' against the amplitude of the strain", .draw = draw_amplitude_response},
        {.name = "stress-strain", .meaning = "stress against strain of a quasi-static ramp", .draw = draw_stress_strain},
        {.name = "compression",
         .meaning = "normal stress against volume fraction of a uniaxial compression",
         .draw = draw_compression},
        {.name = "oscillations",
         .meaning = "stress and strain of the explicit shear test",
         .draw = draw_oscillations,
         .one_file = true},
        {.name = "modulus-stiffness",
         .meaning = "G' against the particle stiffness, from tables of 'coagula calibrate -o'",
         .draw = draw_modulus_stiffness,
         .published = published_modulus_stiffness,
         .input = FigureInput::tables},
        {.name = "modulus-heterogeneity",
         .meaning = "G' against a with the power law, from structures or tables",
         .draw = draw_modulus_heterogeneity,
         .published = published_modulus_heterogeneity,
         .input = FigureInput::both},
        {.name = "critical-value",
         .meaning = "confidence at which each a0 of that law is excluded",
         .draw = draw_critical_value,
         .input = FigureInput::both},
        {.name = "heterogeneity-coordination",
         .meaning = "a against C, one point per structure",
         .draw = draw_heterogeneity_coordination,
         .published = published_heterogeneity_coordination},
        {.name = "modulus-volume-fraction",
         .meaning = "G' against the volume fraction, one point per structure",
         .draw = draw_modulus_volume_fraction},
        {.name = "packing", .meaning = "the spheres as seen from afar", .draw = draw_packing, .one_file = true},
        {.name = "rheometer",
         .meaning = "the sample between the plates of the shear test",
         .draw = draw_rheometer,
         .one_file = true},
        {.name = "overview", .meaning = "the spheres beside the pore curve", .draw = draw_overview, .one_file = true}};
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

}  // namespace

const std::vector<Figure>& figures() {
    static const std::vector<Figure> all = make_table();
    return all;
}

const Figure& figure_named(const std::string& name) {
    const auto found = std::find_if(figures().begin(), figures().end(), [&](const Figure& figure) { return figure.name == name; });
    if (found == figures().end()) {
        std::vector<std::string> names;
        std::transform(figures().begin(), figures().end(), std::back_inserter(names),
                       [](const Figure& figure) { return figure.name; });
        throw InputError("'" + name + "' is not one of " + list_of(names));
    }
    return *found;
}

Drawing draw_figure(const Figure& figure, const Sources& sources, bool published) {
    if (figure.one_file && sources.size() > 1) {
        throw InputError("the figure " + figure.name + " shows one file, but " + std::to_string(sources.size()) + " are given");
    }
    if (published && figure.published == nullptr) {
        throw InputError("no points of the figure " + figure.name + " are published as numbers");
    }
    Drawing drawing = figure.draw(sources);
    if (published) {
        std::vector<Series>& series = drawing.panels.front().series;
        const std::vector<Series> points = figure.published();
        series.insert(series.end(), points.begin(), points.end());
        drawing.caption +=
            " VEM: void expansion; BD: Brownian dynamics. Open: table 2 of Schenker et al., Granular Matter 14 (2012) 333, with "
            "its bars.";
    }
    return drawing;
}

}  // namespace coagula::report
