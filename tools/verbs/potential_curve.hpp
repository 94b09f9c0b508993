// SPDX-License-Identifier: GPL-3.0-or-later
// coagula generate brownian --potential-curve
#pragma once

#include <coagula/generators/pair_potential.hpp>
#include <coagula/stages/arguments.hpp>

namespace coagula::tools {

/// Prints the potential against the gap and draws it where a picture is asked for.
/// @param radius of the particles [m].
void report_potential(const stages::Arguments& arguments, const generators::PairPotential& potential, double radius);

}  // namespace coagula::tools
