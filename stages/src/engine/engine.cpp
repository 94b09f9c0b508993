// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/engine.hpp>

#include "lammps_process.hpp"

#include <utility>

namespace coagula::stages {

std::vector<Option> engine_options(std::vector<std::string> choices, std::string meaning) {
    std::vector<Option> options = {
        choice("engine", std::move(choices), std::move(meaning), "builtin"),
        text("engine-command", "TEXT", "command that runs LAMMPS, such as 'mpirun -n 4 lmp'; lmp when not given")};
    read_only_with(options, {"engine-command"}, "engine", {"lammps"});
    return options;
}

std::optional<LammpsEngine> engine_of(const Arguments& arguments) {
    if (arguments.text("engine") != "lammps") {
        return std::nullopt;
    }
    LammpsEngine engine;
    engine.command.clear();
    for (const std::string& word : split(arguments.text("engine-command", "lmp"), ' ')) {
        if (!word.empty()) {
            engine.command.push_back(word);
        }
    }
    if (engine.command.empty()) {
        throw InputError(arguments.spelled("engine-command") + " names no program");
    }
    check_installed(engine.command);
    return engine;
}

}  // namespace coagula::stages
