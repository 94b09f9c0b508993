// SPDX-License-Identifier: GPL-3.0-or-later
// The program that does the work: coagula itself or another one.
#pragma once

#include <coagula/stages/arguments.hpp>
#include <coagula/stages/option.hpp>

#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

/// Another program that does the work.
struct Engine {
    std::string name;                  ///< in messages
    std::string source;                ///< how to get it
    std::vector<std::string> command;  ///< words, such as {"mpirun", "-n", "4", "lmp"}
};

/// The options `engine` and `engine-command`. @param choices of engines, "builtin" among them. @param meaning of `engine`.
std::vector<Option> engine_options(std::vector<std::string> choices, std::string meaning);

/// The engine `choice`, "lammps" or "petsc"; none where another is chosen. Throws InputError where the program is missing.
std::optional<Engine> engine_of(const Arguments& arguments, const std::string& choice);

}  // namespace coagula::stages
