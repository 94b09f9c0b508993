// SPDX-License-Identifier: GPL-3.0-or-later
// The conditions under which shear results were found, as they stand beside them in the file.
#pragma once

#include <coagula/stages/shear.hpp>

namespace coagula::stages {

/// The options that bear on the results of the method, each with its value, below GROUP/conditions. How the equations are solved,
/// and what is printed where, are no conditions.
Results shear_conditions(const Arguments& arguments, const ShearRun& run);

}  // namespace coagula::stages
