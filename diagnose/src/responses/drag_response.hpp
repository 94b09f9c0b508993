// SPDX-License-Identifier: GPL-3.0-or-later
// Response of a network whose particles the solvent drags on: the frequency solver at the nodes of a grid of reduced frequencies.
#pragma once

#include "response.hpp"

namespace coagula::diagnose {

/// G* / G at an angular frequency [rad/s]; what the contacts lose beside their springs is in both.
std::complex<double> drag_response(Simulator& simulator, const Settings& settings, double angular_frequency, std::size_t group = 0);
/// The same by a run at the settings themselves.
std::complex<double> exact_drag_response(Simulator& simulator, const Settings& settings, double angular_frequency,
                                         std::size_t group = 0);

/// What more structures would add to the logarithm of that less 1 (drag_scatter.hpp): what is expected, then each independent
/// standard error; as many for every group of structures and for all of them together, 0 for those of other groups.
Eigen::RowVectorXcd drag_excess(Simulator& simulator, const Settings& settings, double angular_frequency, std::size_t group = 0);
/// Degrees of freedom from which their common scale is known.
double drag_degrees(Simulator& simulator);

Response drag_of_solvent();

}  // namespace coagula::diagnose
