// The pair potential from the command line, and its curve.
#pragma once

#include "cli/arguments.hpp"
#include "cli/report.hpp"

#include <coagula/generators/pair_potential.hpp>

#include <vector>

namespace coagula::tools {

/// Options of the pair laws.
std::vector<Option> potential_options();

/// The potential of two particles of this radius [m].
/// @param surface_potential [V], instead of that of the options: the stabilised suspension.
generators::PairPotential make_potential(const Arguments& arguments, double radius,
                                         std::optional<double> surface_potential = std::nullopt);

/// Prints energy and force over the gap with barrier and secondary minimum, and draws them (--picture).
void report_potential(const Arguments& arguments, const generators::PairPotential& potential, double radius);

}  // namespace coagula::tools
