// Where the base model fails, in words.
#pragma once

#include "detection.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Departures from the base model of each observable along each axis whose score is above chance, strongest first; then that of the
/// level from a known stiffness and those of samples, likewise. If none is above chance, the strongest along an axis.
std::vector<Failure> localise(const Inference& inference, const Fit& base, const Detection& detection);

}  // namespace coagula::diagnose
