// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that nobody has measured yet.
#pragma once

#include "toml_keys.hpp"

#include <coagula/diagnose/measurement.hpp>

#include <cstddef>
#include <map>
#include <string>

namespace coagula::experiment {

/// By the key `planned`: its axis from an end to the other, and what is constant.
/// @param number of the measurement, from 1. @param constants values in SI units by quantity.
diagnose::Measurement planned_table(TomlKeys& keys, diagnose::MeasurementKind kind, std::size_t number,
                                    const std::map<std::string, double>& constants);

}  // namespace coagula::experiment
