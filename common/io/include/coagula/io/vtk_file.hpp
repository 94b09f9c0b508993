// SPDX-License-Identifier: GPL-3.0-or-later
// VTK XML PolyData (.vtp), which ParaView, VisIt, Mayavi and PyVista open.
#pragma once

#include <coagula/io/structure_file.hpp>

#include <string>
#include <vector>

namespace coagula::io {

/// Writes the centres [m] as points with a vertex each, the bonds that do not pass through a periodic boundary as lines, and radius
/// and id of the particles as point data; through a temporary file and a rename. Numbers are text of full precision.
/// Format: VTK File Formats, "XML File Formats", PolyData.
void write_vtk(const std::string& path, const Structure& structure, bool overwrite);

}  // namespace coagula::io
