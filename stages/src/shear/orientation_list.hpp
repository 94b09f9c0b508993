// SPDX-License-Identifier: GPL-3.0-or-later
// The orientations of a shear test: plate normal and direction, "xy" and so on.
#pragma once

#include <coagula/mechanics/rheometer.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// "xy".
std::string name_of(const mechanics::ShearOrientation& orientation);

/// "all" or a list such as "xy,zx" (normal, direction). Throws InputError for what is none, or is named twice.
std::vector<mechanics::ShearOrientation> parse_orientations(const std::string& text);

}  // namespace coagula::stages
