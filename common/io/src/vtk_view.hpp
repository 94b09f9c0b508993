// SPDX-License-Identifier: GPL-3.0-or-later
// The group /VTKHDF that lets ParaView open a structure file: particles as vertices, bonds as lines.
#pragma once

#include <coagula/io/structure_file.hpp>

#include <optional>
#include <vector>

#include "hdf5_file.hpp"

namespace coagula::io {

/// True when the bond joins the two centres as they lie in the box, not through its boundary.
bool lies_inside(const Packing& packing, const ContactNetwork& bonds, Index bond);

/// Writes points, cells and the point data radius.
void write_view(hdf5::File& file, const Packing& packing, const std::optional<ContactNetwork>& bonds);

/// Writes (or replaces) the cells and the point data coordination; removes the cell data, which belong to the cells.
void write_view_bonds(hdf5::File& file, const Packing& packing, const std::optional<ContactNetwork>& bonds);

/// Writes (or replaces) a field of the point data. Throws std::invalid_argument when its size is not that of the packing.
void write_view_field(hdf5::File& file, Index particles, const ParticleField& field);

/// Writes (or replaces) a field of the cell data: 0 on the vertices, the value of the bond on its line. The cells must be those of
/// `bonds`. Throws std::invalid_argument when there is not one value per bond.
void write_view_bond_field(hdf5::File& file, const Packing& packing, const ContactNetwork& bonds, const BondField& field);

}  // namespace coagula::io
