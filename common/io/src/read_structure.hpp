// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of an H5MD file that is already open.
#pragma once

#include <coagula/io/structure_file.hpp>

#include "hdf5_file.hpp"

namespace coagula::io {

/// The group of /particles that holds the packing: "trajectory", or the only one. Throws InputError when the file is not H5MD.
std::string particles_group(const hdf5::File& file);

/// The last frame as it stands there, not checked yet. Throws InputError naming file and object.
Structure read_structure(const hdf5::File& file);

}  // namespace coagula::io
