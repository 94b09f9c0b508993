// SPDX-License-Identifier: GPL-3.0-or-later
// Errors that know nothing of what is held out.
#pragma once

#include "noise/data_set.hpp"

#include <coagula/diagnose/diagnosis.hpp>

#include <vector>

namespace coagula::diagnose {

/// The same numbers with errors that were estimated anew from the replicates that are not held out; those that tables state stay.
/// @param structure_deviation of the numbers, beside their errors.
DataSet with_errors_of_the_rest(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment,
                                const Eigen::VectorXd& structure_deviation, const DiagnosisOptions& options);

}  // namespace coagula::diagnose
