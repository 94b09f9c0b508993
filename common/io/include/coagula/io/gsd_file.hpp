// SPDX-License-Identifier: GPL-3.0-or-later
// GSD, the binary trajectories of HOOMD-blue: the HOOMD schema in files of versions 1 and 2.
#pragma once

#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <string>

namespace coagula::io {

/// Reads particles/position, particles/diameter and the box, with the options and the rules for frames of read_frames. GSD has no
/// units: lengths are in the unit that the file names in log/coagula/length_unit, as write_gsd does, or in `length_unit`. HOOMD
/// knows periodic boxes only, and diameters of 1 where a file has none; a set with a free surface is told by log/coagula/periodic
/// or by `open`. Throws InputError that names file and object.
///
/// Layout: https://gsd.readthedocs.io, "File layer" and "HOOMD Schema".
Structure read_gsd(const std::string& path, const ImportOptions& options);

/// Writes all frames of a structure in metres, positions in single precision (7 digits) as the schema has them, through a temporary
/// file and a rename.
void write_gsd(const std::string& path, const Structure& structure, bool overwrite);

}  // namespace coagula::io
