// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a pair potential.
#pragma once

#include <string>
#include <vector>

namespace coagula::tools {

struct PotentialCurve {
    std::vector<double> gap;     ///< [m]
    std::vector<double> energy;  ///< [kB T]
    std::vector<double> force;   ///< [N]
    bool logarithmic = true;     ///< axis of the gap
};

/// Throws InputError unless the name ends in .svg, .png or .pdf, which says how the picture is drawn.
void check_picture_name(const std::string& path);

/// Draws the energy over the gap with gnuplot. Throws as check_picture_name and io::write_file do, and std::runtime_error when
/// gnuplot cannot draw.
void draw_potential(const std::string& path, const PotentialCurve& curve, bool overwrite);

}  // namespace coagula::tools
