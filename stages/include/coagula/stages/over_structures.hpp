// SPDX-License-Identifier: GPL-3.0-or-later
// Mean over several structures, with the error that their scatter gives it.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/common/statistics.hpp>

#include <vector>

namespace coagula::stages {

/// {"structures", "mean", "std", "standard_error"}; what is unset is null.
Json to_json(const MeanWithError& found);

/// What several calls of `coagula shear` have in common: for storage_modulus and loss_modulus, or the
/// longitudinal_modulus of a compression, the mean over the structures of the
/// mean over the orientations, a number, or arrays for the entries of a sweep. An entry that a structure has not reached is null.
/// @param structures the object that `coagula shear` prints for each.
Json over_structures(const std::vector<Json>& structures);

/// A row for each structure and one for the mean, where each has one modulus; of sweeps a row for each entry of the mean.
Table table_over_structures(const std::vector<Json>& structures);

}  // namespace coagula::stages
