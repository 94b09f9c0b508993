// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation of a shear test, or the axis of a uniaxial one.
#pragma once

#include <vector>

namespace coagula::mechanics {

/// Plate normal and direction of the shear, 0..2 for x, y, z: a particle at x moves by strain * x[normal] along `direction`. Where
/// both are one axis, the strain is uniaxial: stretch if positive, compression if negative. Quasi-static runs alone take it.
struct ShearOrientation {
    int normal = 2;
    int direction = 0;

    bool is_uniaxial() const { return normal == direction; }
    /// Place of this component of a symmetric tensor: xx, yy, zz, yz, xz, xy.
    int voigt() const { return is_uniaxial() ? normal : 6 - normal - direction; }
};

/// The six orientations of the paper: xy, xz, yx, yz, zx, zy (normal, direction).
std::vector<ShearOrientation> all_orientations();

/// Uniaxial strain along x, y and z.
std::vector<ShearOrientation> uniaxial_orientations();

}  // namespace coagula::mechanics
