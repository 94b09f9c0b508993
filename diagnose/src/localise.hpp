// Where the base model fails, in words.
#pragma once

#include "detection.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Departures of each observable along each axis whose score is above chance, strongest first.
/// @param prediction of the base model, not whitened.
std::vector<Failure> localise(const std::vector<Observation>& observations, const Detection& detection,
                              const Eigen::VectorXd& residual, const Eigen::VectorXd& prediction);

}  // namespace coagula::diagnose
