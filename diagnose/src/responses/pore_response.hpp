// SPDX-License-Identifier: GPL-3.0-or-later
// Pore curves of the structures, as they are and as measured coordinates would show them.
#pragma once

#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Probability that a point of the void space is farther than this [m] from the nearest particle surface, as measured coordinates
/// would show it, mean over the structures.
double exclusion_probability(Simulator& simulator, const Settings& settings, double pore_radius, bool exact = false);

/// How this scatters between structures with this change, as independent standard errors of one of them: radii x errors, as many
/// whatever the change.
Eigen::MatrixXd pore_errors(Simulator& simulator, const StructureChange& change, const std::vector<double>& pore_radii);

}  // namespace coagula::diagnose
