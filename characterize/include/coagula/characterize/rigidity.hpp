// SPDX-License-Identifier: GPL-3.0-or-later
// Local rigidity of a contact network: floppy modes, states of self-stress, where they are, and rigid clusters.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/percolation.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace coagula::characterize {

/// Relative motions that a contact constrains.
enum class Bonds {
    normal_and_shear,  ///< the three relative displacements at the contact point; particles turn, no moment passes through a
                       ///< contact
    central,           ///< the distance of the centres only; particles are points
};

struct RigidityOptions {
    Bonds bonds = Bonds::normal_and_shear;
    /// A motion x is floppy if |A x| is below this fraction of |x|. Exactly floppy ones come out near 1e-15;
    /// Rigidity::largest_zero and smallest_nonzero show the gap.
    double tolerance = 1e-10;
    /// Particles whose relative motion in random floppy motions, of size 1 in mean radii, is below this move as one.
    double rigid_tolerance = 1e-6;
    int random_motions = 8;     ///< that tell rigid clusters apart, >= 1
    std::uint64_t seed = 1;     ///< of these motions
    double memory_limit = 8e9;  ///< for the factor and the entries of its inverse [bytes]
};

/// Thrown when the packing is too large for `memory_limit`.
struct TooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Particles that move as one rigid body in every floppy motion.
struct RigidClusters {
    std::vector<Cluster> clusters;  ///< of two or more particles, largest first; `bonds` counts the pairs of particles up to two
                                    ///< contacts apart that were found rigid, windings are along them
    Eigen::VectorXi of_particle;    ///< N: place in `clusters`; -1: moves against all its neighbours
    Eigen::VectorXd self_stress;    ///< of each cluster: local redundancy of the contacts between its particles
    double largest_rigid = 0;       ///< largest relative motion that counted as none
    double smallest_loose = unset;  ///< smallest that counted; unset if there is none
};

/// With D unknowns per particle, R rows per contact, A the rigidity matrix (R M x D N) and r its rank: D N - r motions cost no
/// energy, R M - r sets of contact forces balance without load (Maxwell 1864; Calladine, Int. J. Solids Struct. 14 (1978) 161).
struct Rigidity {
    Index unknowns = 0;       ///< D N
    Index constraints = 0;    ///< R M
    Index rank = 0;           ///< of A
    Index rigid_motions = 0;  ///< of the sample as a whole: 3 in a periodic cell, at most 6 in an open one
    Index floppy_modes = 0;   ///< unknowns - rank - rigid_motions
    Index rattlers = 0;       ///< particles left with fewer than two contacts when such are removed again and again
    Index rattler_modes =
        0;  ///< those of the floppy modes that are motions of rattlers: D each less R per contact removed with them
    Index self_stresses = 0;          ///< constraints - rank
    double largest_zero = 0;          ///< largest |A x| / |x| of the motions that count as floppy
    double smallest_nonzero = unset;  ///< lower estimate of the smallest other singular value of A; unset if the rank is zero

    /// Diagonal of the projector onto the states of self-stress, summed over the rows of a contact: 0 (no self-stress passes
    /// through it; without it there would be one more floppy mode per row) to R (Hagh and Thorpe's local redundancy; Sussman,
    /// Goodrich and Liu, Soft Matter 12 (2016) 3982). Their sum is self_stresses. All rows count alike, whatever the stiffness.
    Eigen::VectorXd contact_redundancy;   ///< M
    Eigen::VectorXd normal_redundancy;    ///< M: the part along the line of centres; the same for central bonds
    Eigen::VectorXd particle_redundancy;  ///< N: half of each of its contacts'; the sum is self_stresses, too
    Eigen::VectorXd particle_freedom;     ///< N: D less half of the independent constraints of each of its contacts; the sum is the
                                          ///< number of motions without stiffness, floppy_modes + rigid_motions
    double trace_defect = 0;              ///< |sum of contact_redundancy - self_stresses|: rounding errors

    RigidClusters rigid;  ///< empty for central bonds
};

/// Rank by sparse Cholesky factors of A^T A (of A A^T for central forces where contacts are fewer than unknowns) in which one
/// unknown per zero mode is pinned; the choice is verified on A itself, so
/// that stiffness as small as `tolerance` squared is told from none. Local redundancies from the selected inverse: exact. Two
/// particles belong to one rigid cluster if no random floppy motion moves one against the other as seen from a chain of particles
/// up to two contacts apart. docs/measures.md#rigidity. The same bits for any number of threads. Throws std::invalid_argument when
/// the contacts belong to another packing or an option is out of range, TooLarge when the memory limit does not suffice,
/// std::runtime_error when the rank cannot be told.
Rigidity measure_rigidity(const Packing& packing, const ContactNetwork& contacts, const RigidityOptions& options = {},
                          const Progress& progress = {});

}  // namespace coagula::characterize
