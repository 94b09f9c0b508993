// SPDX-License-Identifier: GPL-3.0-or-later
// Linear modulus of the structures: the linear solver at the nodes of a grid of contacts, and between them.
#pragma once

#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>
#include <coagula/mechanics/linear.hpp>

#include <cstddef>
#include <vector>

namespace coagula::diagnose {

constexpr double unit_stiffness = 100;  ///< of a particle [N/m] in all simulations behind moduli, which are proportional to it

/// Response of bonds of unit_stiffness that resist shear and bending and bear tension as these settings say.
mechanics::LinearResponse solve_springs(const Simulator& simulator, const Packing& packing, const ContactNetwork& bonds,
                                        const Settings& settings);

/// Moduli of one structure with these contacts for unit_stiffness [Pa]: mean over the orientations, then the three shear planes.
const std::vector<double>& moduli_of_structure(Simulator& simulator, std::size_t structure, const Settings& settings);

/// G [Pa] at vanishing strain without losses, mean over the structures of a group; group 0: over all. Interpolated between the
/// nodes (cubic, in logarithms), and so are structures that are changed.
double linear_modulus(Simulator& simulator, const Settings& settings, std::size_t group = 0);
/// The same by a run at the settings themselves.
double exact_linear_modulus(Simulator& simulator, const Settings& settings, std::size_t group = 0);

/// Standard deviation of the mean of a group that so few structures leave, over that mean: the scatter between structures of one
/// group at the base settings, pooled over the groups, over the root of their number. Where no group has two structures, that
/// between the three shear planes of one structure takes its place.
double structure_error(Simulator& simulator, std::size_t group = 0);

}  // namespace coagula::diagnose
