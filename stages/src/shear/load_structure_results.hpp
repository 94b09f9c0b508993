// SPDX-License-Identifier: GPL-3.0-or-later
// The load-bearing structure, as data sets, particle fields and lines of the table of `coagula shear`.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/mechanics/load_structure.hpp>

#include <vector>

namespace coagula::stages {

/// Scalars and small tensors below /mechanics/linear/load_structure.
Results load_structure_datasets(const mechanics::LoadStructure& structure, bool periodic);

/// One value per bond and shear, in the order of /connectivity/bonds; rounded to single precision, which halves their space.
Results bond_datasets(const mechanics::LoadStructure& structure);

/// Normal force and backbone on the lines of the bonds, for ParaView.
std::vector<io::BondField> load_structure_bond_fields(const mechanics::LoadStructure& structure);

/// Share of the energy and non-affinity of every particle for the three shears.
std::vector<io::ParticleField> load_structure_fields(const mechanics::LoadStructure& structure);

Table load_structure_table(const mechanics::LoadStructure& structure);

}  // namespace coagula::stages
