// SPDX-License-Identifier: GPL-3.0-or-later
// Results of `coagula shear --method linear` as data sets, particle fields and a table.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/relaxation.hpp>

#include <vector>

namespace coagula::stages {

/// All scalars and tensors below /mechanics/linear.
Results datasets_of(const mechanics::LinearResponse& response, double bond_tolerance, const mechanics::LinearOptions& options);

/// Displacements and rotations of the three shears.
std::vector<io::ParticleField> fields_of(const mechanics::LinearResponse& response);

/// Results of the relaxation before the shear, below the group of the method.
void append_relaxation(const std::string& method_group, Results& results, std::vector<io::ParticleField>& fields,
                       const mechanics::RelaxedNetwork& rest);

Table table_of(const mechanics::LinearResponse& response);

}  // namespace coagula::stages
