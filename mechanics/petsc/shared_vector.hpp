// SPDX-License-Identifier: GPL-3.0-or-later
// Motions and loads of all processes as PETSc vectors: 36 numbers for each particle, its six unknowns under six loads.
#pragma once

#include "part.hpp"

#include <petscvec.h>

namespace coagula::mechanics {

/// Ends the work of all processes with PETSc's own words where it has failed.
void check(PetscErrorCode code);

/// Throws std::runtime_error where PETSc cannot number the unknowns of so many particles.
void check_count(Index particles);

/// Moves numbers between the particles of a process and its neighbours, which other processes own.
class SharedVector {
public:
    explicit SharedVector(const Part& part);
    SharedVector(const SharedVector&) = delete;
    SharedVector& operator=(const SharedVector&) = delete;
    ~SharedVector();

    /// A vector over the particles that the processes own. The caller destroys it.
    Vec make() const;
    /// Six rows for each particle of the part, its neighbours too, from a vector.
    void read(Vec from, Loads& to) const;
    /// The vector gets the rows of its particles and what other processes have for them, added up.
    void add_up(const Loads& from, Vec to) const;
    /// The rows of the particles that this process owns.
    void read_own(Vec from, Loads& to) const;
    void write_own(const Loads& from, Vec to) const;

private:
    Index own_ = 0;
    Index all_ = 0;
    Vec with_neighbours_ = nullptr;
};

/// Adds up numbers over all processes.
void sum_over_processes(double* numbers, Index count);

}  // namespace coagula::mechanics
