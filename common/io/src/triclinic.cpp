// SPDX-License-Identifier: GPL-3.0-or-later
#include "triclinic.hpp"

#include <stdexcept>

namespace coagula::io {

Eigen::Matrix3d triclinic_edges(const Eigen::Vector3d& lengths, const Eigen::Vector3d& tilt) {
    Eigen::Matrix3d edges = lengths.asDiagonal();
    edges(0, 1) = tilt[0];
    edges(0, 2) = tilt[1];
    edges(1, 2) = tilt[2];
    return edges;
}

Cell box_of_edges(const LineReader& file, const Eigen::Vector3d& origin, const Eigen::Matrix3d& edges,
                  const std::array<bool, 3>& periodic) {
    try {
        return Cell::of_edges(origin, edges, periodic);
    } catch (const std::invalid_argument& error) {
        file.fail(error.what());
    }
}

void require_restricted(const std::string& path, const Cell& cell) {
    if (!cell.edges().isUpperTriangular(0) || cell.edges().diagonal().minCoeff() <= 0) {
        throw InputError(
            path +
            ": LAMMPS and HOOMD need the first edge of a box along x and the second in the plane of x and y, and those "
            "of this box lie otherwise; extended XYZ takes any");
    }
}

}  // namespace coagula::io
