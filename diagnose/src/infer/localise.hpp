// SPDX-License-Identifier: GPL-3.0-or-later
// Where the base model fails, and what a cause leaves over.
#pragma once

#include "detection.hpp"
#include "discrepancy.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Departures from the base model of each observable along each axis whose score is above chance, strongest first; then that of the
/// level from a known stiffness and those of samples, likewise. If none is above chance, the strongest along an axis.
std::vector<Misfit> localise(const Inference& inference, const Fit& base, const Detection& detection);

/// Says where a smooth departure lies and how large it is.
/// @param prediction of the model that leaves it over.
void place(const Discrepancy& departing, const DataSet& data, const Eigen::VectorXd& prediction, Remainder& remainder);

}  // namespace coagula::diagnose
