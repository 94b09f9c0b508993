// SPDX-License-Identifier: GPL-3.0-or-later
// Coagulation from a stabilised suspension: particles placed at random, brought to equilibrium behind a high barrier, then left to
// the potential under which they coagulate (docs/explanation/brownian.md).
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>
#include <coagula/generators/size_distribution.hpp>

#include <functional>

namespace coagula::generators {

/// The contact where nothing else is known: stiff enough that no bond breaks by accident.
/// @param radius of the particles [m]. @param temperature [K].
ElasticContact firm_contact(double radius, double temperature);

/// A suspension in equilibrium, without contacts.
/// @param potential of two particles of the mean radius that it is given [m], with a high barrier.
/// @param run that is to follow; what moves the particles is taken from it.
/// @param duration [s]; a quarter of R^2/D if unset: the degree of heterogeneity has long been constant then.
Packing stabilised_suspension(const SuspensionOptions& suspension, const std::function<PairPotential(double)>& potential,
                              BrownianOptions run, double duration = unset, const Progress& progress = {});

/// Particles in water whose double layers add up, with van der Waals attraction and a firm contact.
struct CoagulationOptions {
    Index particles = 8000;              ///< >= 2
    SizeDistribution sizes;              ///< with a mean radius, of which the potential is
    double volume_fraction = unset;      ///< 0 < phi < 0.55
    double surface_potential = unset;    ///< under which they coagulate [V]
    double temperature = 293;            ///< [K]
    double target_coordination = 4.69;   ///< mean number of contacts at which the run ends
    double debye_length = 10e-9;         ///< [m]
    double hamaker_constant = 4.76e-20;  ///< [J]
    double relative_permittivity = 81;
    double stabilising_potential = 0.05;  ///< surface potential of the suspension in equilibrium [V]
    std::uint64_t seed = 1;
};

/// What needs no simulation. Throws std::invalid_argument for impossible options, and InputError when the barrier is too high for
/// anything to coagulate.
void check(const CoagulationOptions& options);

/// The packing at the target coordination. Throws as `check` does, and InputError when the suspension does not coagulate so far
/// within some diffusion times.
Packing coagulate(const CoagulationOptions& options, const Progress& progress = {});

}  // namespace coagula::generators
