// SPDX-License-Identifier: GPL-3.0-or-later
// Diameters of the particles of a GSD file.
#pragma once

#include <cstdint>
#include <vector>

namespace coagula::io {

class GsdFile;

/// The diameters of the particles of a frame, in the unit of the file: those of the shapes of their types (particles/type_shapes,
/// or the state of a Monte Carlo simulation) where these have one, otherwise particles/diameter, which is 1 where it is missing.
///
/// Throws InputError for shapes that are no spheres, and where the shape of a particle and its stored diameter differ.
/// Source: schema hoomd, https://gsd.readthedocs.io.
std::vector<double> gsd_diameters(const GsdFile& file, std::uint64_t frame, std::size_t count);

}  // namespace coagula::io
