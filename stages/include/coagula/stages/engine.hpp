// SPDX-License-Identifier: GPL-3.0-or-later
// Which program moves the particles: this one or LAMMPS.
#pragma once

#include <coagula/stages/arguments.hpp>
#include <coagula/stages/option.hpp>

#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

/// LAMMPS, as a command.
struct LammpsEngine {
    std::vector<std::string> command = {"lmp"};  ///< words
};

/// The options `engine` and `engine-command`.
std::vector<Option> engine_options();

/// None where coagula itself does the work. Throws InputError where the program is missing.
std::optional<LammpsEngine> engine_of(const Arguments& arguments);

}  // namespace coagula::stages
