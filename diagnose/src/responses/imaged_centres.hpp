// SPDX-License-Identifier: GPL-3.0-or-later
// What errors of localisation do to the neighbours of a particle and to images of the same particles: structures with errors at the
// nodes of a grid.
#pragma once

#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace coagula::diagnose {

/// Mean number of neighbours of a particle in a shell of distance (observables/neighbour_shells.hpp) as measured coordinates would
/// show it, mean over the structures.
double neighbours(Simulator& simulator, const Settings& settings, std::size_t shell, bool exact = false);
/// Errors of these that so few structures leave open, as independent standard errors: shells x errors.
Eigen::MatrixXd neighbour_errors_of_structures(Simulator& simulator);
/// Errors that dense and thin places give an image of so many centres, beside those of independent pairs, likewise.
/// @param mutual share of the neighbours that are centres, too.
Eigen::MatrixXd neighbour_errors_of_image(Simulator& simulator, double centres, double mutual);

/// What images of the same particles differ by, which no structure enters but through wrong matches: standard deviations of a
/// centre in the plane and along z over the diameter, and the share of the centres that the next image does not have
/// (observables/repeated_images.hpp).
std::array<double, 3> repeated_images(Simulator& simulator, const Settings& settings, bool exact = false);

}  // namespace coagula::diagnose
