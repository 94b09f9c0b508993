// SPDX-License-Identifier: GPL-3.0-or-later
// Making structures: by void expansion, and by coagulation of a suspension.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/generators/brownian_dynamics.hpp>
#include <coagula/generators/pair_potential.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/checkpointing.hpp>
#include <coagula/stages/engine.hpp>
#include <coagula/stages/findings.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

/// A structure that a generator made, and what is known of it.
struct Generated {
    io::Structure structure;
    Findings findings;
};

/// The results that a file keeps of a generator: those of the void expansion follow from the structure and the options.
Results kept_results(const Findings& generated);

struct VemRun {
    generators::VoidExpansionOptions expansion;
};

Verb generate_vem_verb();
/// @param radii N radii [m] instead of those that the options say; empty: none.
VemRun vem_run(const Arguments& arguments, const Eigen::VectorXd& radii = {});
Generated generate(const VemRun& run, const Progress& progress);

/// Attraction by a polymer that does not adsorb: of its depth and of its range one is given each.
struct Depletion {
    std::optional<double> depth;          ///< [kB T]
    std::optional<double> concentration;  ///< of the polymer over its overlap concentration
    std::optional<double> range;          ///< [m]
    std::optional<double> size_ratio;     ///< radius of gyration over the radius of the particles

    /// [m]. Throws InputError for one that is not short beside the particles. @param radius of the particles [m].
    double range_of(double radius) const;
};

/// The pair potential of particles by their mean radius.
struct PairForces {
    std::optional<Depletion> depletion;             ///< in place of attraction and double layer
    std::optional<generators::TabulatedLaw> table;  ///< in place of attraction and double layer
    generators::DoubleLayer layer;                  ///< its surface potential is unset with a table
    bool superposition = true;                      ///< of the double layers; else Hogg, Healy and Fuerstenau
    double hamaker_constant = 0;                    ///< [J]
    std::optional<double> yukawa_energy;            ///< at contact [J]
    double yukawa_length = unset;                   ///< [m]
    std::optional<double> contact_stiffness;        ///< [N/m]; chosen by firm_contact when empty
    std::optional<double> equilibrium_gap;          ///< [m]; chosen by firm_contact when empty
};

PairForces pair_forces(const Arguments& arguments);

/// @param radius of both particles [m].
/// @param surface_potential instead of that of the forces, and of their table [V].
generators::PairPotential make_potential(const PairForces& forces, double radius,
                                         std::optional<double> surface_potential = std::nullopt);
/// The potential of the suspension before it coagulates: a high surface potential, or no polymer.
generators::PairPotential make_stable_potential(const PairForces& forces, double radius, double surface_potential);

/// How a suspension is brought to equilibrium before it coagulates.
struct Suspension {
    generators::SuspensionOptions placed;
    double stabilising_potential = 0.05;  ///< surface potential [V]
    double duration = unset;              ///< [s]; chosen when unset
};

struct BrownianRun {
    generators::BrownianOptions motion;
    PairForces forces;
    std::optional<Suspension> suspension;  ///< none: the run goes on from a packing
    bool heterogeneity = false;            ///< is measured at the start, at the snapshots and at the end
    Checkpointing checkpoint;
    double checkpoint_interval = 60;    ///< wall-clock time [s]
    std::optional<Engine> lammps = {};  ///< moves the particles; the suspension before it coagulates is made without it
};

Verb generate_brownian_verb();
/// @param start the packing from which the run goes on; null: a suspension is made. @param radii as above.
BrownianRun brownian_run(const Arguments& arguments, const Packing* start = nullptr, const Eigen::VectorXd& radii = {});
/// @param start as above.
Generated generate(const BrownianRun& run, const Packing* start, const Progress& progress);

/// Structures of one trajectory. Each is made of the run that made the one before, and equals bit by bit what its own run makes.
class Trajectory {
public:
    /// @param run differs from the one before in its end only, which is not earlier, and has the same samples.
    Generated next(const BrownianRun& run, const Progress& progress);

private:
    std::optional<Packing> start_;
    std::optional<generators::BrownianCheckpoint> reached_;
};

}  // namespace coagula::stages
