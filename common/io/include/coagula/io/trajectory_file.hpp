// SPDX-License-Identifier: GPL-3.0-or-later
// All frames of a structure file.
#pragma once

#include <coagula/io/structure_file.hpp>

#include <string>

namespace coagula::io {

/// read_structure with the frames before the last one as `earlier`, and the times; the numbers of the frames where the file has no
/// times in seconds. Throws InputError also when the box is not that of the last frame in all of them.
Structure read_trajectory(const std::string& path);

}  // namespace coagula::io
