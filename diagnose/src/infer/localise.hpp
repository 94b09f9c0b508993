// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences that say where the base model fails.
#pragma once

#include "detection.hpp"
#include "remainder.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <string>
#include <vector>

namespace coagula::diagnose {

/// Departures from the base model of each observable along each axis whose score is above chance, strongest first; then that of the
/// level from a known stiffness and those of samples, likewise. If none is above chance, the strongest along an axis.
std::vector<Failure> localise(const Inference& inference, const Fit& base, const Detection& detection);

/// Where a remainder lies and how large it is, in a sentence.
/// @param prediction of the model that leaves it over.
std::string place_of(const SmoothRemainder& remainder, const DataSet& data, const Eigen::VectorXd& prediction);

}  // namespace coagula::diagnose
