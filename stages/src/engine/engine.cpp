// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/engine.hpp>

#include "engine_process.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace coagula::stages {

namespace {

const std::string petsc_program = "coagula-petsc";

/// The program for PETSc beside this one, where it is installed; otherwise it is looked for as any other.
std::string petsc_beside_this() {
    std::error_code none;
    const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe", none).replace_filename(petsc_program);
    return !none && std::filesystem::exists(beside, none) ? beside.string() : petsc_program;
}

Engine described(const std::string& choice) {
    if (choice == "petsc") {
        return {.name = "PETSc",
                .source = "it is built with coagula where PETSc is found (Debian: apt-get install libpetsc-real-dev)",
                .command = {petsc_program}};
    }
    return {.name = "LAMMPS", .source = "Debian: apt-get install lammps", .command = {"lmp"}};
}

/// Throws InputError where mpirun or srun has started coagula itself several times: each would do the whole work, for one file.
void check_started_once(const Engine& engine) {
    for (const char* const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
        const char* const size = std::getenv(variable);
        if (size != nullptr && std::atoi(size) > 1) {
            throw InputError(std::string("coagula was started ") + size + " times at once (" + variable +
                             "): start it once, and give the command that starts " + engine.name +
                             " so often as the engine command");
        }
    }
}

}  // namespace

std::vector<Option> engine_options(std::vector<std::string> choices, std::string meaning) {
    const std::vector<std::string> others(choices.begin() + 1, choices.end());
    std::vector<Option> options = {
        choice("engine", std::move(choices), std::move(meaning), "builtin"),
        text("engine-command", "TEXT",
             "command that runs the engine, such as 'mpirun -n 4 lmp'; its program alone when not given")};
    read_only_with(options, {"engine-command"}, "engine", others);
    return options;
}

std::optional<Engine> engine_of(const Arguments& arguments, const std::string& choice) {
    if (arguments.text("engine") != choice) {
        return std::nullopt;
    }
    Engine engine = described(choice);
    check_started_once(engine);
    if (arguments.has("engine-command")) {
        engine.command.clear();
        for (const std::string& word : split(arguments.text("engine-command"), ' ')) {
            if (!word.empty()) {
                engine.command.push_back(word);
            }
        }
        if (engine.command.empty()) {
            throw InputError(arguments.spelled("engine-command") + " names no program");
        }
    }
    for (std::string& word : engine.command) {
        word = word == petsc_program ? petsc_beside_this() : word;
    }
    check_installed(engine);
    return engine;
}

}  // namespace coagula::stages
