// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation of a shear test.
#pragma once

#include <vector>

namespace coagula::mechanics {

/// Plate normal and direction of the shear, 0..2 for x, y, z: a particle at x moves by strain * x[normal] along `direction`.
struct ShearOrientation {
    int normal = 2;
    int direction = 0;
};

/// The six orientations of the paper: xy, xz, yx, yz, zx, zy (normal, direction).
std::vector<ShearOrientation> all_orientations();

}  // namespace coagula::mechanics
