// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures share, and their functions for the table.
//
// Results are read before a chart or series is put into braces: where an initialiser inside braces throws, GCC 12 destroys the
// members before it twice.
#pragma once

#include "published_structures.hpp"

#include <coagula/report/figures.hpp>

#include <string>
#include <vector>

namespace coagula::report {

using Sources = std::vector<FigureSource>;

// One function per figure, for the table in figures.cpp.
Drawing draw_pore_curve(const Sources& sources);
Drawing draw_bond_forces(const Sources& sources);
Drawing draw_frequency_response(const Sources& sources);
Drawing draw_amplitude_response(const Sources& sources);
Drawing draw_stress_strain(const Sources& sources);
Drawing draw_compression(const Sources& sources);
Drawing draw_oscillations(const Sources& sources);
Drawing draw_modulus_volume_fraction(const Sources& sources);
Drawing draw_heterogeneity_coordination(const Sources& sources);
Drawing draw_modulus_heterogeneity(const Sources& sources);
Drawing draw_critical_value(const Sources& sources);
Drawing draw_modulus_stiffness(const Sources& sources);
Drawing draw_packing(const Sources& sources);
Drawing draw_overview(const Sources& sources);
Drawing draw_rheometer(const Sources& sources);

/// The figures of the measures of a packing, for the table.
std::vector<Figure> measure_figures();

// The published points of those that have some.
std::vector<Series> published_heterogeneity_coordination();
std::vector<Series> published_modulus_heterogeneity();
std::vector<Series> published_modulus_stiffness();

/// The published structures, one series per generator. @param error may be null.
std::vector<Series> published_series(double (*x)(const PublishedStructure&), double (*y)(const PublishedStructure&),
                                     double (*error)(const PublishedStructure&));

// Axes that several figures have.
ChartAxis heterogeneity_axis();
ChartAxis modulus_axis_of(const std::string& name, const std::string& plain);

/// Legend entry of a file among several; nothing where there is one file without a label, for it needs no legend.
std::string legend_name(const Sources& sources, std::size_t k);

/// The number with so many significant digits.
std::string with_digits(double value, int digits);

}  // namespace coagula::report
