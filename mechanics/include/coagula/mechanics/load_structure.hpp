// SPDX-License-Identifier: GPL-3.0-or-later
// What carries the load of a sheared network: fabric, contact forces, backbone, non-affinity. Definitions:
// docs/explanation/load-structure.md.
#pragma once

#include <coagula/common/fabric.hpp>
#include <coagula/common/percolation.hpp>
#include <coagula/mechanics/linear.hpp>

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace coagula::mechanics {

struct LoadStructureOptions {
    double backbone_energy = 0.9;  ///< share of the elastic energy that the backbone stores, > 0 and < 1
    std::vector<bool> held;        ///< as in LinearOptions
};

/// Distribution of |f_n| over its mean.
struct ForceDistribution {
    Index bonds = 0;
    double mean = 0;               ///< of |f_n| [N per unit strain]
    double bin_width = 0;          ///< of `density`
    Eigen::VectorXd density = {};  ///< probability density of |f_n| / mean, bins from 0 on
    double beyond = 0;             ///< share of the bonds beyond the last bin
    Index tail_bonds = 0;          ///< bonds with |f_n| above twice the mean
    /// Maximum-likelihood slope b of exp(-b |f_n| / mean) above twice the mean and its standard error for independent forces;
    /// both 0 when fewer than ten bonds are there.
    double tail_slope = 0;
    double tail_slope_error = 0;
    double tail_variation = 0;  ///< standard deviation over mean of the excess above twice the mean: 1 for an exponential
};

/// @param normal_force of every bond that counts [N per unit strain]; either sign.
ForceDistribution distribution_of_forces(const Eigen::VectorXd& normal_force);

/// The smallest set of bonds that stores a given share of the energy.
struct Backbone {
    std::vector<bool> bond = {};  ///< M flags
    Index bonds = 0;
    Index particles = 0;   ///< with at least one such bond
    Index clusters = 0;    ///< connected parts
    Cluster largest = {};  ///< the part with most particles
};

/// Displacements u of some particles beyond the affine ones, per unit strain over the mean radius; in a periodic cell relative to
/// their median (of each component, over the load-bearing particles), which fixes the free translation. A few particles that hang
/// between nearly straight links move by thousands: they rule mean square and participation, of all more than of the backbone,
/// but not the median.
struct NonAffinity {
    Index particles = 0;
    double mean_square = 0;    ///< of u
    double median = 0;         ///< of |u|
    double participation = 0;  ///< (sum u^2)^2 / (n sum u^4); 0 when none moves
};

/// One unit shear strain (engineering, symmetric).
struct ShearLoad {
    bool carried = false;  ///< false: the modulus is zero; then forces and shares are zero, too
    std::string reason;    ///< why nothing is carried, half a sentence; empty if `carried`

    Eigen::Matrix3Xd force;         ///< 3 x M: pull of the second particle on the first [N per unit strain]
    Eigen::VectorXd normal_force;   ///< M: its part along the bond, positive where the bond is pulled [N per unit strain]
    Eigen::VectorXd shear_force;    ///< M: magnitude of the rest, >= 0 [N per unit strain]
    Eigen::VectorXd energy_share;   ///< M: of the whole energy
    double energy = 0;              ///< of all bonds [J per unit strain squared]; half of modulus times volume in a periodic cell
    double shear_spring_share = 0;  ///< share of the energy in the shear springs

    std::array<double, 3> strongest_share{};  ///< energy in the strongest 10, 20 and 50 % of all bonds over the whole
    Fabric force_fabric;                      ///< weighted by |f_n|
    ForceDistribution distribution;           ///< of the bonds that can carry load
    Backbone backbone;

    Eigen::VectorXd particle_energy_share;  ///< N: half of each bond's share to each end
    double energy_participation = 0;        ///< (sum e)^2 / (N sum e^2) over all particles
    Eigen::VectorXd particle_non_affinity;  ///< N: |u| beyond the affine one per unit strain over the mean radius; 0 for rattlers
    NonAffinity non_affinity;               ///< of the load-bearing particles that are not held
    NonAffinity backbone_non_affinity;      ///< of those among them that belong to the backbone
};

struct LoadStructure {
    Fabric fabric;                     ///< of all bonds
    std::array<bool, 3> percolates{};  ///< whether some cluster reaches around the box along x, y, z; false in an open cell
    Index clusters = 0;                ///< of two or more bonded particles (or one that meets its own image)
    Index largest_cluster = 0;         ///< its particles
    std::array<ShearLoad, 3> shear;    ///< yz, xz, xy: Voigt 3, 4, 5 of the response
    double backbone_energy = unset;    ///< as asked for

    /// One sentence: that shear is carried, or in which planes it is not and why.
    std::string summary() const;
};

/// Analyses a response that solve_linear found for the same packing and bonds. Bonds that cannot carry load (dangling ends, links
/// without moment) have force zero; in a sample with held particles, so have the bonds between those.
///
/// A plane counts as carrying nothing when its modulus is below 1e-8 of the affine one: the size of rounding errors.
/// Throws std::invalid_argument when response, bonds and packing do not belong together or an option is out of range.
LoadStructure find_load_structure(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& response,
                                  const LoadStructureOptions& options = {});

}  // namespace coagula::mechanics
