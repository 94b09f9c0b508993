// SPDX-License-Identifier: GPL-3.0-or-later
// H5MD files of other programs (https://nongnu.org/h5md).
#pragma once

#include <coagula/io/structure_file.hpp>
#include <coagula/io/text_formats.hpp>

#include <string>

namespace coagula::io {

/// Reads a packing or a trajectory. A unit of length or radii that the file does not have come from the options, and particles are
/// sorted by the element id where there is one. Frames are counted from 0. Throws InputError naming file and object when something
/// is missing or contradictory.
Structure read_h5md(const std::string& path, const ImportOptions& options);

}  // namespace coagula::io
