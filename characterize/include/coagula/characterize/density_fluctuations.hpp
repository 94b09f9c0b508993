// SPDX-License-Identifier: GPL-3.0-or-later
// Density fluctuations: how the solid volume in cubic windows varies with their position, against their size.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::characterize {

/// Window edges between which the curve is integrated, over r0: the same for all packings, so that they can be compared.
inline constexpr double smallest_window = 2;
inline constexpr double largest_window = 10;

/// Relative standard deviation of the solid volume of the particles whose centres lie in a window. After the density-fluctuation
/// method of Schenker et al., Phys. Rev. E 80 (2009) 021302; a particle counts by its centre, so that points at random have 1 /
/// sqrt(mean number). In a periodic box with N particles the variance is divided by 1 - window volume / box volume, which is what a
/// fixed N takes off that of points at random.
struct DensityFluctuations {
    Eigen::VectorXd edge;             ///< of the windows, ascending [m]
    Eigen::VectorXd deviation;        ///< standard deviation over mean
    Eigen::VectorXd deviation_error;  ///< standard errors from sub-volumes; NaN if unknown
    double integral = unset;          ///< of the deviation over edge / r0 from 2 to `largest`; NaN if there are no such windows
    double integral_error = unset;
};

/// Windows at every point of a grid with a spacing of r0 / 2 or, in boxes of more than 1.6e7 such points, more. In an open packing
/// only windows count that lie where the nearest particle is an inner one. The integral takes the deviation for a power law of the
/// edge between two windows. Throws std::invalid_argument when no window of edge 2 r0 fits twice into the box.
/// @param inner N flags of inner_particles.hpp. @param largest edge over r0 up to which the curve is integrated, 2 to 10.
DensityFluctuations measure_density_fluctuations(const Packing& packing, const std::vector<bool>& inner,
                                                 double largest = largest_window);

/// Where the curves of two packings with edges in the same unit differ most: the window edge and the difference of the deviations
/// there (second minus first), over the edges that both have.
struct LargestDifference {
    double edge = unset;
    double difference = unset;
    double error = unset;  ///< standard error of the difference
};
LargestDifference compare_density_fluctuations(const DensityFluctuations& first, const DensityFluctuations& second);

}  // namespace coagula::characterize
