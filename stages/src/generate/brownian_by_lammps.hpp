// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian dynamics by LAMMPS.
#pragma once

#include <coagula/generators/engine_run.hpp>
#include <coagula/stages/engine.hpp>

#include <string>

namespace coagula::stages {

struct LammpsBrownianRun {
    generators::BrownianRun run;
    std::string version;    ///< of LAMMPS
    double memory = unset;  ///< time in which the velocity of a particle is forgotten [s]
};

/// Throws InputError for a packing that LAMMPS cannot move here: of particles of different size, or in a box that leans or is not
/// periodic all around. @param radii of the particles.
void check_for_lammps(const Eigen::VectorXd& radii, const Cell* cell, double cutoff_gap);

/// Throws as simulate_brownian does, and std::runtime_error with the last error of LAMMPS when it fails.
LammpsBrownianRun brownian_by_lammps(const Engine& engine, const Packing& start, const generators::PairPotential& potential,
                                     const generators::BrownianOptions& options, const Progress& progress);

}  // namespace coagula::stages
