// SPDX-License-Identifier: GPL-3.0-or-later
// Void expansion method: packings of chosen heterogeneity, made by growing void particles among the structure particles.
// Schenker, Filser, Gauckler, Aste, Herrmann, Phys. Rev. E 80 (2009) 021302.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula::generators {

/// What to generate. Lengths in metres.
struct VoidExpansionOptions {
    Index particles = 8000;             ///< number of structure particles N, >= 3
    Index voids = 4000;                 ///< number of void particles N_V, >= 1; fewer voids make a more heterogeneous packing
    double volume_fraction = unset;     ///< of the structure particles, 0 < phi < 0.64
    Eigen::VectorXd radii;              ///< N radii [m]; see size_distribution.hpp
    double target_coordination = 4.69;  ///< mean number of contacts at which the expansion stops, 0 < C < 6
    double contact_tolerance = 0.01;    ///< pairs nearer than (1 + tolerance) (r_i + r_j) count as contacts
    std::uint64_t seed = 1;
};

/// What came out of it.
struct VoidExpansion {
    Packing packing;              ///< the structure particles in a periodic cube
    ContactNetwork contacts;      ///< pairs within the contact tolerance
    double coordination = unset;  ///< mean number of contacts
    double overlap_rms = unset;   ///< over the contacts (0 where in tension), as a fraction of the mean diameter; < 0.005
    double overlap_max = unset;   ///< the same, largest
    double void_radius = unset;   ///< at which the voids were deleted [m]
    Index increments = 0;         ///< of the void radius
    Index steps = 0;              ///< explicit time steps in all
};

/// Throws std::invalid_argument for impossible options.
void check(const VoidExpansionOptions& options);

/// Runs the method: particles and voids are placed at random, overlaps of the particles removed, and the voids grown in small
/// steps; close to the target, after each step, a copy without voids is bonded and relaxed, and the first that reaches the target
/// is the result. Void radii are relative to the mean radius. The result depends on the options alone, not on the number of
/// threads. Throws as `check` does, and InputError when the target coordination cannot be reached: too
/// high for so many voids, or lower than that of the packing without voids, since growing voids only add contacts.
VoidExpansion expand_voids(const VoidExpansionOptions& options, const Progress& progress = {});

}  // namespace coagula::generators
