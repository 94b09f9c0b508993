// SPDX-License-Identifier: GPL-3.0-or-later
// Free forms: what a link of the chain may do that no cause of the catalogue says, as a smooth departure along an axis that acts
// where the link acts. A material, its history, plates and structures scale G*, plates by what they take of the strain; a tool adds
// a torque or turns the phase; errors belong to one sample.
#pragma once

#include "hypothesis.hpp"
#include "observables/coordinate.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// The free form of a kind of departure, at a fit of the base model.
struct FreeForm {
    Kind kind;
    double log_factor = 0;           ///< on the evidence of the base model, averaged over amplitudes, lengths and shapes
    Eigen::VectorXd departure = {};  ///< most probable one of the best, of every number [its unit]
};

/// The coordinate that an axis is; an age is a time. None of those that are no coordinate of a row.
Coordinate coordinate_along(Axis axis);

/// Finds the free forms of all links along all axes that these data vary.
std::vector<FreeForm> free_forms(const Inference& inference, const Fit& base);

/// The factor on the evidence of the base model by an instrument that reads torque or angle not in proportion, also where these run
/// with the strain, so that no free form tells them from the material; as a logarithm.
double log_factor_of_readings(const Inference& inference, const Fit& base);

}  // namespace coagula::diagnose
