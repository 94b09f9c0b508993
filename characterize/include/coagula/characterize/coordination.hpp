// SPDX-License-Identifier: GPL-3.0-or-later
// Coordination number, rattlers and overlaps.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct CoordinationOptions {
    double contact_tolerance = 0.01;  ///< pairs nearer than (1 + tolerance) (r_i + r_j) are in contact
};

/// Means and fractions are over the inner particles (inner_particles.hpp): all of a periodic packing; of an open one those away
/// from its free surface, where neighbours are missing. An open packing so small that none is inner is averaged as a whole.
struct Coordination {
    double mean = unset;                   ///< contacts per inner particle, rattlers included
    double mean_without_rattlers = unset;  ///< contacts with other than rattlers, per inner particle that is no rattler; 0 if none
    double rattler_fraction = unset;  ///< particles that carry no load: those left with fewer than two contacts when such particles
                                      ///< are removed again and again
    double below_three_fraction = unset;  ///< particles with fewer than three contacts
    double mean_all = unset;              ///< contacts per particle over all particles, a free surface included
    Index inner_particles = 0;            ///< N in a periodic packing; 0 if an open packing has none
    Eigen::VectorXi counts;               ///< N, contacts of each particle
    Eigen::VectorXi histogram;            ///< number of particles (of all) with 0, 1, 2 ... contacts
    ContactNetwork contacts;              ///< of all particles
};

Coordination measure_coordination(const Packing& packing, const CoordinationOptions& options = {});

/// Contacts left to each particle (N) when those with fewer than two are removed again and again; -1 for the removed, the rattlers.
Eigen::VectorXi prune_rattlers(const ContactNetwork& contacts);

/// Overlap of the contacts as a fraction of r_i + r_j; zero for pairs that do not overlap.
struct Overlaps {
    double mean = unset;  ///< over the overlapping pairs; 0 if there are none
    double rms = unset;   ///< over the same pairs
    double max = unset;
    Index pairs = 0;               ///< number of overlapping pairs
    double implied_noise = unset;  ///< standard deviation of a coordinate that would explain the overlaps if the overlapping
                                   ///< spheres just touched in truth: rms overlap / sqrt(2) [m]; 0 if there are none
};
Overlaps measure_overlaps(const Packing& packing);

}  // namespace coagula::characterize
