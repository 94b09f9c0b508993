// SPDX-License-Identifier: GPL-3.0-or-later
// Pair correlation function g(r): how much more often than in an ideal gas two particles lie at a distance.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct PairCorrelationOptions {
    double range = unset;             ///< largest distance [m]; unset: as far as the sample allows, at most 12 mean diameters. More
                                      ///< than half the shortest length of a periodic cell is refused
    double bin_width = 0.05;          ///< in units of the distance of touching centres (mean diameter), 0.01 to 1
    double contact_tolerance = 0.01;  ///< pairs within (1 +- tolerance)(r_i + r_j) have a bin of their own, 0.002 to 0.1
};

/// A radial distribution in bins. The bin of the contacts is separate from its neighbours, so that the peak of touching particles
/// does not smear over a wide bin. Expected numbers are exact shell volumes times the density of other particles; in an open
/// packing only those particles are centres whose whole shell lies in the convex hull of all (minus sampling).
struct RadialDistribution {
    Eigen::VectorXd lower, upper;  ///< edges of the bins
    Eigen::VectorXd g;             ///< mean over each bin
    Eigen::VectorXd g_stderr;      ///< from blocks of space (blocks.hpp)
    Eigen::VectorXd neighbours;    ///< mean number of particles nearer than `upper` to a particle
    Index contact_bin = 0;         ///< which bin holds the contacts
};

struct PairCorrelation {
    RadialDistribution by_distance;  ///< edges in m
    RadialDistribution by_contact;   ///< edges in units of r_i + r_j of each pair: contacts of spheres of any size lie at 1. For
                                     ///< equal spheres the same distribution
    double contact_peak = unset;     ///< mean number of neighbours in the contact bin
    double contact_peak_stderr = unset;
    double contact_value =
        unset;  ///< g at r_i + r_j, extrapolated from outside the contact bin by a parabola over a quarter of
                ///< the contact distance; of a hard-sphere fluid it gives the pressure. NaN where no parabola fits
    double contact_value_stderr = unset;  ///< of the weighted least squares, pairs independent
    double number_density = unset;        ///< [1/m^3]
    Index centres = 0;                    ///< particles that see the nearest shell whole: N, if periodic
};

/// O(N) for a fixed range. Throws std::invalid_argument if the range does not fit.
PairCorrelation measure_pair_correlation(const Packing& packing, const PairCorrelationOptions& options = {});

}  // namespace coagula::characterize
