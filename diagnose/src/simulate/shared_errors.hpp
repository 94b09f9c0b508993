// Errors of what images and pore curves show of the structures.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/simulator.hpp>

#include "observables/observations.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Errors that several numbers share, as independent standard errors: observations x errors, as many whatever the change of the
/// structures.
///
/// Those that so few structures leave in neighbours (Simulator::neighbour_errors_of_structures) and in pores
/// (Simulator::pore_errors) are the same for all tables. An image has errors of its own in all shells
/// (Simulator::neighbour_errors_of_image). So has a pore curve that states no errors: its sample is taken to be as large as a
/// simulated structure.
Eigen::MatrixXd shared_errors(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator,
                              const StructureChange& change);

}  // namespace coagula::diagnose
