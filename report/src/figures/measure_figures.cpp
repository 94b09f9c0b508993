// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the measures of a packing, one entry each.
#include "figure_parts.hpp"

namespace coagula::report {

namespace {

/// The path of a result of coagula characterize.
std::string measured(const std::string& name) {
    return "/characterization/" + name;
}

/// An axis whose name has markup in gnuplot.
ChartAxis axis(const std::string& name, const std::string& plain) {
    return {.name = name, .plain = plain};
}
ChartAxis axis(const std::string& name) {
    return axis(name, name);
}
ChartAxis density() {
    return {.name = "probability density", .plain = "probability density", .from_zero = true};
}

HistogramFigure contacts() {
    HistogramFigure figure;
    figure.path = measured("coordination_histogram");
    figure.x_axis = axis("contacts of a particle");
    figure.of = "particles";
    figure.caption = "Fraction of the particles with a given number of contacts.";
    return figure;
}

CurveFigure pair_correlation() {
    return {.x = measured("pair_correlation/distance"),
            .y = measured("pair_correlation/g"),
            .x_axis = axis("distance {/:Italic r}", "distance"),
            .y_axis = {.name = "pair correlation {/:Italic g}({/:Italic r})", .plain = "pair correlation", .logarithmic = true},
            .caption = "Pairs of centres at a distance over those of an ideal gas. Contacts have a narrow bin of their own.",
            .y_error = measured("pair_correlation/g_stderr")};
}

CurveFigure structure_factor() {
    return {.x = measured("structure_factor/wave_number"),
            .y = measured("structure_factor/direct"),
            .x_axis = axis("wave number {/:Italic q}", "wave number"),
            .y_axis = {.name = "structure factor {/:Italic S}({/:Italic q})", .plain = "structure factor", .from_zero = true},
            .caption = "Structure factor of the centres from wave vectors, with standard errors; dashed: from g(r).",
            .y_error = measured("structure_factor/direct_stderr"),
            .other = measured("structure_factor/transformed"),
            .other_name = "from g(r)",
            .name = "from wave vectors"};
}

CurveFigure bond_angles() {
    return {.x = measured("bond_angles/angle"),
            .y = measured("bond_angles/density"),
            .x_axis = axis("angle between two contacts"),
            .y_axis = density(),
            .caption =
                "Distribution of the angles between the contacts of a particle. Independent directions would have half the sine.",
            .y_error = measured("bond_angles/density_stderr")};
}

CurveFigure neighbour_distances() {
    return {.x = measured("neighbour_distances/distance"),
            .y = measured("neighbour_distances/density"),
            .x_axis = axis("distance to the nearest centre"),
            .y_axis = density(),
            .caption = "Distribution of the distance from a centre to the nearest other."};
}

CurveFigure bond_order() {
    return {.x = measured("bond_order/value"),
            .y = measured("bond_order/q6_density"),
            .x_axis = axis("{/:Italic q}_6, {/:Italic q}_4", "q6, q4"),
            .y_axis = density(),
            .caption =
                "Distribution of the bond-orientational order q6 over the particles, facets of the Voronoi cells weighted by "
                "area; dashed: q4.",
            .other = measured("bond_order/q4_density"),
            .other_name = "q4",
            .name = "q6"};
}

CurveFigure voronoi() {
    return {.x = measured("voronoi/free_volume"),
            .y = measured("voronoi/density"),
            .x_axis = axis("free volume of a Voronoi cell over its mean"),
            .y_axis = density(),
            .caption = "Distribution of the Voronoi volumes less the smallest possible one, over the mean; dashed: gamma law.",
            .other = measured("voronoi/fit"),
            .other_name = "gamma law",
            .name = "measured"};
}

CurveFigure density_fluctuations() {
    return {
        .x = measured("density_fluctuations/edge"),
        .y = measured("density_fluctuations/deviation"),
        .x_axis = {.name = "edge of the window", .plain = "edge of the window", .logarithmic = true},
        .y_axis = {.name = "deviation of the solid volume", .plain = "relative deviation of the solid volume", .logarithmic = true},
        .caption = "Standard deviation over mean of the solid volume in cubic windows, against their edge.",
        .y_error = measured("density_fluctuations/deviation_stderr")};
}

/// A functional of the union of the growing spheres.
CurveFigure minkowski(const std::string& name, const std::string& y_axis) {
    return {.x = measured("minkowski/dilation"),
            .y = measured("minkowski/" + name),
            .x_axis = axis("dilation of the spheres"),
            .y_axis = axis(y_axis),
            .caption = "Union of the spheres as all radii grow by the same length: " + y_axis + " over volume, exact."};
}

CurveFigure chord_lengths(const std::string& phase, const std::string& where) {
    return {.x = measured("chord_lengths/" + phase + "/length"),
            .y = measured("chord_lengths/" + phase + "/density"),
            .x_axis = axis("length of a chord " + where),
            .y_axis = density(),
            .caption = "Distribution of the lengths of the pieces that straight lines have " + where + "."};
}

CurveFigure local_redundancy() {
    return {.x = measured("rigidity/redundancy"),
            .y = measured("rigidity/redundancy_density"),
            .x_axis = axis("redundant constraints at a particle"),
            .y_axis = density(),
            .caption = "Distribution of the local redundancy: states of self-stress shared out to the particles."};
}

HistogramFigure rings() {
    HistogramFigure figure;
    figure.path = measured("rings/count");
    figure.x_axis = axis("particles of a ring");
    figure.of = "rings";
    figure.caption = "Fraction of the shortest-path rings of the contact network with a given number of particles.";
    return figure;
}

}  // namespace

std::vector<Figure> measure_figures() {
    return {
        {.name = "pore-curve",
         .meaning = "exclusion probability of the pores with the fitted error function",
         .draw = draw_pore_curve},
        {.name = "contacts", .meaning = "fraction of the particles with 0, 1, 2 ... contacts", .draw = histogram(contacts())},
        {.name = "pair-correlation", .meaning = "pair correlation function g(r)", .draw = curve(pair_correlation())},
        {.name = "structure-factor", .meaning = "structure factor S(q), directly and from g(r)", .draw = curve(structure_factor())},
        {.name = "neighbour-distances", .meaning = "distribution of the nearest distances", .draw = curve(neighbour_distances())},
        {.name = "bond-angles", .meaning = "distribution of the angles between contacts", .draw = curve(bond_angles())},
        {.name = "bond-order", .meaning = "distribution of q6 and q4 over the particles", .draw = curve(bond_order())},
        {.name = "rings", .meaning = "sizes of the rings of contacts", .draw = histogram(rings())},
        {.name = "local-redundancy", .meaning = "distribution of the local redundancy", .draw = curve(local_redundancy())},
        {.name = "voronoi", .meaning = "distribution of the Voronoi volumes with the gamma law", .draw = curve(voronoi())},
        {.name = "density-fluctuations",
         .meaning = "deviation of the solid volume against the window",
         .draw = curve(density_fluctuations())},
        {.name = "void-chords",
         .meaning = "lengths of the chords in the void",
         .draw = curve(chord_lengths("void", "in the void"))},
        {.name = "solid-chords",
         .meaning = "lengths of the chords in the spheres",
         .draw = curve(chord_lengths("solid", "in the spheres"))},
        {.name = "surface", .meaning = "surface of the growing spheres", .draw = curve(minkowski("surface", "surface"))},
        {.name = "mean-curvature",
         .meaning = "integrated mean curvature of the growing spheres",
         .draw = curve(minkowski("mean_curvature", "mean curvature"))},
        {.name = "euler-characteristic",
         .meaning = "Euler characteristic of the growing spheres",
         .draw = curve(minkowski("euler_characteristic", "Euler characteristic"))}};
}

}  // namespace coagula::report
