// SPDX-License-Identifier: GPL-3.0-or-later
// Attraction of spheres by a polymer that does not adsorb, as a Morse well (docs/explanation/brownian.md), and what such a well
// says about the bonds of a gel.
#pragma once

#include <coagula/generators/pair_potential.hpp>

#include <optional>
#include <vector>

namespace coagula::generators {

/// The attraction of two spheres of equal radius by a polymer.
struct DepletionAttraction {
    double depth = unset;                     ///< of the well [J], > 0
    double range = unset;                     ///< gap at which the attraction ends, twice the radius of gyration [m], > 0
    double rest_gap = unset;                  ///< gap at the bottom of the well [m], > 0
    std::optional<double> contact_stiffness;  ///< where the well becomes stiffer than this it is elastic [N/m]
};

/// Energy of two spheres in contact over -kB T (Asakura and Oosawa, J. Polym. Sci. 33 (1958) 183; Vrij, Pure Appl. Chem. 48 (1976)
/// 471): concentration (1 + 3/(2 size_ratio)), the overlap of the two depleted zones times the osmotic pressure of ideal coils.
/// @param concentration of the polymer in the liquid between the spheres over its overlap concentration c*, 4 pi/3 r_g^3 times the
/// number density of the coils, > 0. @param size_ratio r_g over the radius of the spheres, > 0.
double depletion_depth(double concentration, double size_ratio);

/// Morse's well with a sixth of the range as its length, so that it has half a per cent of its depth left where the attraction
/// ends (3/r_g: Zia, Landrum, Russel, J. Rheol. 58 (2014) 1121). Without a contact stiffness it acts down to the gap where its
/// energy is zero, and the elastic contact continues it with its slope there, 12 depth/length^2; a contact of given stiffness takes
/// over where the well has that slope. Throws std::invalid_argument for a contact softer than the bottom of the well.
/// @param others laws that act besides.
PairPotential depletion_potential(const DepletionAttraction& attraction, std::vector<PairLaw> others = {});

/// Two spheres in a well.
struct BoundPair {
    double stiffness = unset;          ///< second derivative of the energy at the bottom of the well [N/m]
    double thermal_stiffness = unset;  ///< kB T over the variance of the distance of a bound pair [N/m]
    double rupture_force = unset;      ///< largest attraction [N]
};

/// What the well of a potential says about the bonds that it makes. The variance is that of Boltzmann's distribution of the
/// distances up to the bond range. A distance is one component of a displacement, so kB T stands where 3 kB T stands over the
/// variance of all three. Throws std::invalid_argument for a potential without a well of its own.
/// @param radius of both spheres [m], > 0. @param temperature [K], > 0. @param bond_range gap up to which a pair is bound [m].
BoundPair bound_pair(const PairPotential& potential, double radius, double temperature, double bond_range);

}  // namespace coagula::generators
