// SPDX-License-Identifier: GPL-3.0-or-later
// The option --size-distribution: "monodisperse", "normal:0.1", "lognormal:0.2" or the name of a table.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula::stages {

/// The radii [m] of the particles: `given`, or where that is empty drawn as the options --particles, --radius and
/// --size-distribution say. A table is CSV with the columns "radius [unit]" and "fraction" (share of the particles, any scale).
/// Throws InputError that names the option, or the file and line of a table, also for an option beside which another one decides.
Eigen::VectorXd radii_of(const Arguments& arguments, const Eigen::VectorXd& given, std::uint64_t seed);

}  // namespace coagula::stages
