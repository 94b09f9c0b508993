// A picture of a pair potential.
#pragma once

#include <string>
#include <vector>

namespace coagula::tools {

struct PotentialCurve {
    std::vector<double> gap;     ///< [m]
    std::vector<double> energy;  ///< [kB T]
    std::vector<double> force;   ///< [N]
};

/// Draws the energy over the gap with gnuplot; the ending of the name (.png, .svg) says how. Throws InputError for another ending,
/// std::runtime_error when gnuplot cannot be run.
void draw_potential(const std::string& path, const PotentialCurve& curve);

}  // namespace coagula::tools
