// SPDX-License-Identifier: GPL-3.0-or-later
// Radii of the particles: monodisperse, normal, lognormal or from a table.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <cstdint>

namespace coagula::generators {

enum class SizeKind {
    monodisperse,
    normal,     ///< cut off 3 standard deviations from the mean
    lognormal,  ///< its logarithm is normal, cut off at 3 standard deviations of the logarithm
    table,      ///< given radii with given number fractions
};

/// Distribution of the radius by number. Lengths in metres.
struct SizeDistribution {
    SizeKind kind = SizeKind::monodisperse;
    /// Not for `table`.
    double mean_radius = unset;
    /// Standard deviation over mean, of the distribution before it is cut: normal 0 to 0.3, lognormal 0 to 0.5.
    double relative_deviation = unset;
    /// `table`: any number of radii [m] ...
    Eigen::VectorXd table_radius = {};
    /// ... and the share of particles with each, > 0; scaled to the sum 1.
    Eigen::VectorXd table_fraction = {};
};

/// n radii [m] in random order. Stratified: the median of each of n equally probable intervals (in a table: the nearest whole
/// numbers of particles), so that few particles represent the distribution, too; the seed decides the order only. For the
/// continuous kinds the radii are scaled to the exact mean. Throws std::invalid_argument when a parameter is missing or out of
/// range.
Eigen::VectorXd draw_radii(const SizeDistribution& sizes, Index n, std::uint64_t seed);

}  // namespace coagula::generators
