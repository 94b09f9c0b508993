// SPDX-License-Identifier: GPL-3.0-or-later
// Gain of a diagnosis on data held out.
#pragma once

#include "attribution.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// Groups of observations held out together: in turn each sample all of whose tables were measured in the same way on another, too;
/// else in turn the tables that were measured alike; else the rows at the end of the axis of every table, once. No fold leaves
/// fewer than four numbers.
std::vector<std::vector<bool>> choose_folds(const Experiment& experiment, const std::vector<Observation>& observations,
                                            double part);

/// For each fold the errors are estimated and the cause is chosen and fitted on the rest alone; then its prediction of what was
/// held out is compared with that of the base model and of a smooth correction. Densities are those of the posterior prediction:
/// parameters drawn, effects of the samples and all errors as in the rest.
Gain measure_gain(const DataSet& all, const std::vector<std::vector<bool>>& folds, const Experiment& experiment,
                  Simulator& simulator, const Hypothesis& possible, const DiagnosisOptions& options);

/// The same numbers with errors that were estimated anew from the replicates that are not held out; those that tables state stay.
/// @param structure_deviation of the numbers, beside their errors.
DataSet with_errors_of_the_rest(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment,
                                const Eigen::VectorXd& structure_deviation, const DiagnosisOptions& options);

}  // namespace coagula::diagnose
