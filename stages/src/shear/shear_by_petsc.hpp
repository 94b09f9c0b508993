// SPDX-License-Identifier: GPL-3.0-or-later
// The linear problem solved by PETSc, by as many processes as the command of the engine starts.
#pragma once

#include <coagula/mechanics/linear.hpp>
#include <coagula/stages/engine.hpp>
#include <coagula/stages/scratch_folder.hpp>

#include <string>

namespace coagula::stages {

/// Has the equations of linear responses solved by PETSc.
class PetscSolver {
public:
    PetscSolver(const Engine& engine, const Progress& progress) : engine_(engine), progress_(progress) {}

    /// The options of a linear response get this solver, which must live as long as they do. It throws std::runtime_error with what
    /// PETSc or mpirun says where it fails.
    void serve(mechanics::LinearOptions& options);
    /// "3.18.5, 4 processes", once it has solved a problem; empty before.
    const std::string& version() const { return version_; }

private:
    void solve(const std::filesystem::path& problem, const std::filesystem::path& solution);

    const Engine& engine_;
    const Progress& progress_;
    ScratchFolder scratch_;
    std::string version_;
};

}  // namespace coagula::stages
