// SPDX-License-Identifier: GPL-3.0-or-later
// Which program does the work: this one or another.
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

/// The options `engine` and `engine-command`. @param choices of engines, "builtin" among them. @param meaning of `engine`.
std::vector<Option> engine_options(std::vector<std::string> choices, std::string meaning);

/// None where another engine than LAMMPS does the work. Throws InputError where the program is missing.
std::optional<LammpsEngine> engine_of(const Arguments& arguments);

}  // namespace coagula::stages
