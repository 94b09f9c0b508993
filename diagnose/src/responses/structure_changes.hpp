// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of structures that are made again with something changed.
#pragma once

#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <functional>

namespace coagula::diagnose {

/// The answer of structures with these changes, between the nodes of a grid of each; several changes add up.
double over_changes(Simulator& simulator, const StructureChange& change, const std::function<double(Simulator&)>& asked);
Eigen::MatrixXd over_changes(Simulator& simulator, const StructureChange& change,
                             const std::function<Eigen::MatrixXd(Simulator&)>& asked);

}  // namespace coagula::diagnose
