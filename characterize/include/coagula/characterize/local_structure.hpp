// SPDX-License-Identifier: GPL-3.0-or-later
// The surroundings of a particle: angles between contacts, common neighbours and distances to the nearest particles.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <array>
#include <map>

namespace coagula::characterize {

struct BondAngleOptions {
    double contact_tolerance = 0.01;  ///< as for the coordination number
    Index bins = 60;                  ///< over 0 to 180 degrees
};

/// Angles between the contacts of a particle, over the inner particles.
struct BondAngles {
    Eigen::VectorXd angle;           ///< middle of each bin [rad]
    Eigen::VectorXd density;         ///< probability density [1/rad]; independent directions have sin(angle) / 2
    Eigen::VectorXd density_stderr;  ///< from blocks of space (blocks.hpp)
    Index angles = 0;                ///< pairs of contacts; without any the density is 0
    double mean = unset;             ///< [rad]; NaN if there are no angles
    double mean_stderr = unset;
    double below_equilateral = unset;  ///< fraction nearer than 65 degrees: particles of touching triangles
    double below_equilateral_stderr = unset;
};

BondAngles measure_bond_angles(const Packing& packing, const BondAngleOptions& options = {});

struct CommonNeighbourOptions {
    double contact_tolerance = 0.01;
};

/// Common-neighbour analysis (Honeycutt and Andersen, J. Phys. Chem. 91 (1987) 4950), by contacts: of each contact the number of
/// common neighbours, of the contacts among these, and of those in their longest chain. And the kind of lattice around each
/// particle by the adaptive analysis of Stukowski (Modelling Simul. Mater. Sci. Eng. 20 (2012) 045021), which needs no cut-off.
struct CommonNeighbours {
    std::map<std::array<int, 3>, double> fraction;  ///< of the contacts of inner particles, by signature; (4, 2, 1) is all of fcc
    double mean = unset;                            ///< common neighbours of a contact; 0 without contacts
    double mean_stderr = unset;                     ///< from blocks of space (blocks.hpp), as the following
    /// Fractions of the inner particles; the rest has no such order.
    double fcc = unset, hcp = unset, bcc = unset, icosahedral = unset;
    double fcc_stderr = unset, hcp_stderr = unset, bcc_stderr = unset, icosahedral_stderr = unset;
};

CommonNeighbours measure_common_neighbours(const Packing& packing, const CommonNeighbourOptions& options = {});

struct NeighbourDistanceOptions {
    Index neighbours = 12;  ///< distances up to this neighbour, 1 to 100
    Index bins = 100;       ///< of the distribution of nearest distances, from 0 to the largest
};

/// Distances of centres to the nearest, second nearest ... centre, over the inner particles of the packing; and the gaps between
/// surfaces. In an open packing the nearest neighbour of an inner particle is certain, farther ones nearly always.
struct NeighbourDistances {
    Eigen::VectorXd mean;         ///< to the k-th neighbour [m], k = 1, 2 ...
    Eigen::VectorXd mean_stderr;  ///< from blocks of space (blocks.hpp)
    Eigen::VectorXd distance;     ///< middle of each bin [m]
    Eigen::VectorXd density;      ///< H(r), probability density of the nearest distance [1/m]
    double smallest = unset;      ///< [m]
    double smallest_stderr = unset;
    double spread = unset;  ///< standard deviation of the nearest distance [m]
    double spread_stderr = unset;
    double mean_gap = unset;  ///< mean distance of surfaces to the particle nearest by surface; negative for overlaps [m]
    double mean_gap_stderr = unset;
};

/// Throws std::invalid_argument in an open packing of fewer than neighbours + 1 particles.
NeighbourDistances measure_neighbour_distances(const Packing& packing, const NeighbourDistanceOptions& options = {});

}  // namespace coagula::characterize
