// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_vector.hpp"

#include <petscsys.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

constexpr PetscInt numbers_of_particle = 36;

PetscInt to_petsc(Index number) {
    if (number > std::numeric_limits<PetscInt>::max()) {
        throw std::runtime_error("PETSc was built with indices too short for " + std::to_string(number / numbers_of_particle) +
                                 " particles: a PETSc with 64-bit indices is needed");
    }
    return static_cast<PetscInt>(number);
}

}  // namespace

void check(PetscErrorCode code) {
    if (code != 0) {
        const char* text = nullptr;
        PetscErrorMessage(code, &text, nullptr);
        throw std::runtime_error(text != nullptr ? text : "error " + std::to_string(code));
    }
}

void check_count(Index particles) {
    to_petsc(numbers_of_particle * particles);
}

SharedVector::SharedVector(const Part& part) : own_(part.own), all_(static_cast<Index>(part.particle.size())) {
    std::vector<PetscInt> neighbours;
    std::transform(part.neighbour.begin(), part.neighbour.end(), std::back_inserter(neighbours), to_petsc);
    check(VecCreateGhostBlock(PETSC_COMM_WORLD, numbers_of_particle, to_petsc(numbers_of_particle * own_), PETSC_DETERMINE,
                              to_petsc(static_cast<Index>(neighbours.size())), neighbours.data(), &with_neighbours_));
}

SharedVector::~SharedVector() {
    VecDestroy(&with_neighbours_);
}

Vec SharedVector::make() const {
    Vec vector = nullptr;
    check(VecCreateMPI(PETSC_COMM_WORLD, to_petsc(numbers_of_particle * own_), PETSC_DETERMINE, &vector));
    return vector;
}

void SharedVector::read(Vec from, Loads& to) const {
    check(VecCopy(from, with_neighbours_));
    check(VecGhostUpdateBegin(with_neighbours_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecGhostUpdateEnd(with_neighbours_, INSERT_VALUES, SCATTER_FORWARD));
    Vec local = nullptr;
    const PetscScalar* values = nullptr;
    check(VecGhostGetLocalForm(with_neighbours_, &local));
    check(VecGetArrayRead(local, &values));
    to.resize(6 * all_, 6);
    std::copy_n(values, to.size(), to.data());
    check(VecRestoreArrayRead(local, &values));
    check(VecGhostRestoreLocalForm(with_neighbours_, &local));
}

void SharedVector::add_up(const Loads& from, Vec to) const {
    Vec local = nullptr;
    PetscScalar* values = nullptr;
    check(VecGhostGetLocalForm(with_neighbours_, &local));
    check(VecGetArrayWrite(local, &values));
    std::copy_n(from.data(), from.size(), values);
    check(VecRestoreArrayWrite(local, &values));
    check(VecGhostRestoreLocalForm(with_neighbours_, &local));
    check(VecGhostUpdateBegin(with_neighbours_, ADD_VALUES, SCATTER_REVERSE));
    check(VecGhostUpdateEnd(with_neighbours_, ADD_VALUES, SCATTER_REVERSE));
    check(VecCopy(with_neighbours_, to));
}

void SharedVector::read_own(Vec from, Loads& to) const {
    const PetscScalar* values = nullptr;
    check(VecGetArrayRead(from, &values));
    to.resize(6 * own_, 6);
    std::copy_n(values, to.size(), to.data());
    check(VecRestoreArrayRead(from, &values));
}

void SharedVector::write_own(const Loads& from, Vec to) const {
    PetscScalar* values = nullptr;
    check(VecGetArrayWrite(to, &values));
    std::copy_n(from.data(), numbers_of_particle * own_, values);
    check(VecRestoreArrayWrite(to, &values));
}

void sum_over_processes(double* numbers, Index count) {
    check(MPI_Allreduce(MPI_IN_PLACE, numbers, to_petsc(count), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
}

}  // namespace coagula::mechanics
