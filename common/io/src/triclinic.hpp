// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of any shape, as the formats of others write them. Internal.
#pragma once

#include <coagula/common/cell.hpp>

#include <array>
#include <string>

#include "text_reader.hpp"

namespace coagula::io {

/// The edges of LAMMPS's and HOOMD's restricted triclinic box. @param tilt the lengths xy, xz, yz.
Eigen::Matrix3d triclinic_edges(const Eigen::Vector3d& lengths, const Eigen::Vector3d& tilt);

/// A box of a text file. Throws InputError unless its edges are finite and span a volume.
Cell box_of_edges(const LineReader& file, const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges,
                  const std::array<bool, 3>& periodic);

/// Throws InputError unless the first edge lies along x and the second in the plane of x and y.
void require_restricted(const std::string& path, const Cell& cell);

}  // namespace coagula::io
