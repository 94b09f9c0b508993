// SPDX-License-Identifier: GPL-3.0-or-later
// coagula-petsc -problem FILE -solution FILE [options of PETSc]: solves the linear problem of a network that `coagula shear
// --engine petsc` has written, on all processes that mpirun or srun starts.
#include "shared_vector.hpp"
#include "solve.hpp"
#include "solvers/schwarz.hpp"

#include <coagula/common/blas_kernels.hpp>
#include <coagula/common/blas_threads.hpp>

#include <omp.h>
#include <petscsys.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

namespace {

using namespace coagula::mechanics;

/// The value of an option of the command line; throws std::runtime_error where it is missing.
std::string value_of(const char* option) {
    std::array<char, PETSC_MAX_PATH_LEN> value{};
    PetscBool given = PETSC_FALSE;
    check(PetscOptionsGetString(nullptr, nullptr, option, value.data(), value.size(), &given));
    if (given == PETSC_FALSE) {
        throw std::runtime_error(std::string(option) + " FILE is missing: coagula shear --engine petsc calls this program");
    }
    return value.data();
}

void solve_file(const std::string& problem_path, const std::string& solution_path) {
    int process = 0;
    int processes = 1;
    MPI_Comm_rank(PETSC_COMM_WORLD, &process);
    MPI_Comm_size(PETSC_COMM_WORLD, &processes);
    if (process == 0) {
        std::printf("PETSc %d.%d.%d, %d process%s\n", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR, processes,
                    processes == 1 ? "" : "es");
    }
    const coagula::BlasThreads threads(1);
    const ProblemFile problem(problem_path);
    const Part part = part_of(problem, process, processes, SchwarzOptions{}.overlap);
    const SharedSolution solution = solve_together(problem, part);
    if (process == 0) {
        create_solution(solution_path, problem.particles());
    }
    MPI_Barrier(PETSC_COMM_WORLD);
    write_motion(solution_path, {part.particle.begin(), part.particle.begin() + part.own}, solution.motion);
    MPI_Barrier(PETSC_COMM_WORLD);
    if (process == 0) {
        write_summary(solution_path, solution.summary);
    }
}

}  // namespace

int main(int count, char** words) {
    coagula::take_newest_blas_kernels();
    if (std::getenv("OMP_NUM_THREADS") == nullptr) {
        omp_set_num_threads(1);  // one process for each core
    }
    if (PetscInitialize(&count, &words, nullptr, nullptr) != 0) {
        return 1;
    }
    try {
        solve_file(value_of("-problem"), value_of("-solution"));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "ERROR: %s\n", error.what());
        MPI_Abort(PETSC_COMM_WORLD, 1);
    }
    return PetscFinalize() == 0 ? 0 : 1;
}
