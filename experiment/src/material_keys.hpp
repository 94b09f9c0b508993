// SPDX-License-Identifier: GPL-3.0-or-later
// The table [material] of an experiment file.
#pragma once

#include "toml_keys.hpp"

#include <coagula/diagnose/measurement.hpp>

namespace coagula::experiment {

diagnose::Material read_material(TomlKeys& keys);

}  // namespace coagula::experiment
