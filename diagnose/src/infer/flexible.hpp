// SPDX-License-Identifier: GPL-3.0-or-later
// The base model with a smooth correction, as a prediction of what it has not seen.
#pragma once

#include "noise/data_set.hpp"
#include "smooth.hpp"

#include <vector>

namespace coagula::diagnose {

/// Prediction of all observations by the best of the smooth departures from `base`, conditioned on the observations in `known`.
Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known,
                                    const SmoothDepartures& departures);

}  // namespace coagula::diagnose
