// SPDX-License-Identifier: GPL-3.0-or-later
// A packing of spheres: the value that all stages exchange.
#pragma once

#include <coagula/common/cell.hpp>

#include <Eigen/Core>

#include <string>

namespace coagula {

using Index = Eigen::Index;

/// Spheres in a cell. Plain value: particles are named by their column.
struct Packing {
    Cell cell;
    Eigen::Matrix3Xd positions;  ///< 3 x N, centres [m]; inside the cell when it is periodic
    Eigen::VectorXd radii;       ///< N [m]

    Index size() const { return positions.cols(); }
};

/// Throws std::invalid_argument naming the first particle whose position or radius is not finite, whose radius is not positive,
/// that lies outside a periodic cell, or that shares its centre with another; also when there are no particles.
/// @param name what the sentence calls the packing, such as the file it came from.
void check(const Packing& packing, const std::string& name = "the packing");

/// Sum of the volumes of the spheres [m^3]; overlaps are counted twice.
double solid_volume(const Packing& packing);

/// Solid volume over cell volume (overlaps counted twice, as the literature does).
double volume_fraction(const Packing& packing);

/// True when all radii are equal to within 1e-12 relative.
bool is_monodisperse(const Packing& packing);

/// The mean radius [m]: the r0 in which reduced lengths are given.
double mean_radius(const Packing& packing);

}  // namespace coagula
