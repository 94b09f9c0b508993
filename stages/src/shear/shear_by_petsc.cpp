// SPDX-License-Identifier: GPL-3.0-or-later
#include "shear_by_petsc.hpp"

#include "engine/engine_process.hpp"

#include <fstream>

namespace coagula::stages {

namespace {

/// The program prints a line "PETSc 3.18.5, 4 processes": returns what follows the name.
std::string version_in(const std::filesystem::path& output) {
    const std::string name = "PETSc ";
    std::ifstream file(output);
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(name)) {
            return line.substr(name.size());
        }
    }
    return "of unknown version";
}

}  // namespace

void PetscSolver::serve(mechanics::LinearOptions& options) {
    options.folder = scratch_.path();
    options.call = [this](const auto& problem, const auto& solution) { solve(problem, solution); };
}

void PetscSolver::solve(const std::filesystem::path& problem, const std::filesystem::path& solution) {
    const std::filesystem::path output = scratch_.path() / "output.txt";
    EngineProcess process(engine_, {"-problem", problem.string(), "-solution", solution.string()}, no_input, output);
    process.finish([&] { progress_.update("solving", 0.5, engine_.command.front()); });
    version_ = version_in(output);
}

}  // namespace coagula::stages
