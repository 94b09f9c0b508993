// SPDX-License-Identifier: GPL-3.0-or-later
// The units of the inner loops: mean radius, kB T and the diffusion time of a particle of mean radius.
#pragma once

#include "contact_springs.hpp"

#include <coagula/generators/brownian_dynamics.hpp>

#include <numbers>

namespace coagula::generators {

struct ReducedUnits {
    double length;  ///< mean radius [m]
    double energy;  ///< kB T [J]
    double time;    ///< R^2/D [s]

    ReducedUnits(double mean_radius, const BrownianOptions& options)
        : length(mean_radius),
          energy(boltzmann_constant * options.temperature),
          time(length * length * 6 * std::numbers::pi * options.viscosity * length / (options.slowing * energy)) {}
};

/// The force begins to fade at this share of the cut-off gap.
inline constexpr double fading_share = 0.8;

/// How the force is shared between the two tables; gaps in units of the mean radius.
struct ForceRanges {
    double near_start;  ///< up to here everything is near
    double near_end;    ///< from here on everything is far
    double cutoff;      ///< no force beyond
};

ForceRanges choose_ranges(const PairPotential& potential, const ReducedUnits& units, const BrownianOptions& options);

/// Refuses values out of range and a rolling resistance on contacts that slide freely.
SpringRules spring_rules(const PairPotential& potential, const ContactResistance& resistance, const ReducedUnits& units);

/// dF/dgap in reduced units.
double force_slope(const PairPotential& potential, const ReducedUnits& units, double gap);

}  // namespace coagula::generators
