// SPDX-License-Identifier: GPL-3.0-or-later
// What the potential of a gel says about its bonds, as `generate brownian --law depletion` writes it into the file.
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>
#include <coagula/generators/pair_potential.hpp>
#include <coagula/stages/findings.hpp>

#include <optional>
#include <string>

namespace coagula::stages {

/// Bonds in the well of a potential.
struct BondPotential {
    double stiffness = unset;          ///< of a bond, by the curvature of the well at its bottom [N/m]
    double thermal_stiffness = unset;  ///< of a bond, by the thermal motion of a bound pair [N/m]
    double tolerance = unset;          ///< pairs nearer than (1 + tolerance) (r_i + r_j) attract each other
};

/// Where the file has it.
inline const std::string bond_potential_group = "/generation/brownian/potential";

/// What is written and printed about the bonds of a potential with a well of its own: results of the group above.
/// @param attraction_range beyond the gap at rest [m].
Findings bond_findings(const generators::PairPotential& potential, double radius, double temperature, double attraction_range);

/// @param results of a generator, or of the file; empty where they say nothing about bonds.
std::optional<BondPotential> bond_potential_in(const Results& results);
/// The potential of the bonds that a file states.
std::optional<BondPotential> bond_potential_of(const std::string& path);

}  // namespace coagula::stages
