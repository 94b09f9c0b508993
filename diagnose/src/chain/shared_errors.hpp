// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of what images and pore curves show of the structures.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/simulator.hpp>

#include "observables/observations.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

// Errors that several numbers share, as independent standard errors: observations x errors.

/// Errors of images, then those of pores. The structures leave an error in neighbours, the same for all images
/// (neighbour_errors_of_structures); an image has errors of its own in all shells (neighbour_errors_of_image).
Eigen::MatrixXd shared_errors(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator);

/// Errors of pores (pore_errors) alone, as many whatever the change of the structures: what these leave, the same for all
/// tables, then those of each table that states no errors. Its sample is taken to be as large as a simulated structure.
Eigen::MatrixXd errors_of_pores(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator,
                                const StructureChange& change);

}  // namespace coagula::diagnose
