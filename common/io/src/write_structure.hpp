// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a structure before it is closed.
#pragma once

#include <coagula/io/structure_file.hpp>

#include "hdf5_file.hpp"

namespace coagula::io {

/// Builds the file that write_structure writes. @param path is named in messages.
hdf5::File built_structure(const std::string& path, const Structure& structure, const std::vector<ParticleField>& fields,
                           const std::vector<Dataset>& results, const Provenance& provenance, const std::vector<Addition>& later);

}  // namespace coagula::io
