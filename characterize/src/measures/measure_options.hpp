// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several measures share.
#pragma once

#include <coagula/characterize/measure.hpp>

namespace coagula::characterize {

inline MeasureOption contact_tolerance_option() {
    return {"contact-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are in contact", 0.01, 0, 1};
}

inline MeasureOption radii_option() {
    return {"radii", "", "number of radii of the pore-size curve", 200, 4, 100000};
}

inline MeasureOption pore_tolerance_option() {
    return {"pore-tolerance", "1", "error allowed in the pore-size curve of unequal spheres; 0: exact, slow", 5e-5, 0, 1e-2};
}

}  // namespace coagula::characterize
