// SPDX-License-Identifier: GPL-3.0-or-later
// These are the files and commands that LAMMPS reads for a Brownian run. Lengths are in radii, energies in kB T and times in
// R^2/D; the mobility of a particle is then 1, and its mass is the time in which its velocity is forgotten.
#pragma once

#include <coagula/common/packing.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace coagula::stages {

/// A run of particles of one radius.
struct LammpsBrownian {
    std::filesystem::path folder;  ///< with start.data and force.table; LAMMPS writes its frames there
    double mass = 0;
    double time_step = 0;
    std::uint64_t seed = 1;
    std::size_t rows = 0;  ///< of the table of the force
};

/// start.data: the particles. @param length the unit [m].
std::string lammps_start(const Packing& packing, double length);

/// Rows of a table that reaches so far.
std::size_t lammps_table_rows(double last);

/// force.table: force and energy by the distance of the centres, up to `last`. @param force by the distance; 0 at `last`.
std::string lammps_force_table(const std::function<double(double)>& force, double last);

/// The commands before the first step.
std::string lammps_setup(const LammpsBrownian& run);

/// Where frame `number` lies when it is complete.
std::filesystem::path lammps_frame(const LammpsBrownian& run, int number);

/// The commands that move the particles by so many steps and write frame `number`, counted from 0.
std::string lammps_piece(const LammpsBrownian& run, std::int64_t steps, int number);

}  // namespace coagula::stages
