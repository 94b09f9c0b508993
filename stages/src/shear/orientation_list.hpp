// SPDX-License-Identifier: GPL-3.0-or-later
// The orientations of a shear test: plate normal and direction, "xy" and so on, or "zz" of a uniaxial one.
#pragma once

#include <coagula/mechanics/orientation.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// "xy".
std::string name_of(const mechanics::ShearOrientation& orientation);

/// "all" or a list such as "xy,zx" (normal, direction) of some of them. Throws InputError for what is none, or is named twice.
std::vector<mechanics::ShearOrientation> parse_orientations(const std::string& text,
                                                            const std::vector<mechanics::ShearOrientation>& all);

}  // namespace coagula::stages
