// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the pair potential.
#pragma once

#include <coagula/stages/generate.hpp>

#include <vector>

namespace coagula::stages {

std::vector<Option> potential_options();

}  // namespace coagula::stages
