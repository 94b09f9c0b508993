// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of pairs by distance in fine bins, and what an ideal gas would have. Internal.
#pragma once

#include "sample/sample_window.hpp"

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

/// Which distance is counted: that of the centres over the mean diameter, or over the distance r_i + r_j at contact.
enum class PairDistance { by_mean_diameter, by_contact };

/// Rows are bins of equal width from zero, columns are blocks of space (blocks.hpp) in which the centres lie. Each pair counts for
/// both of its particles, if the window holds the particle's whole shell.
struct PairHistogram {
    double width = 0;          ///< of a bin, in the unit of the distance
    Eigen::MatrixXd pairs;     ///< found
    Eigen::MatrixXd expected;  ///< in an ideal gas of the same density
    Eigen::VectorXd centres;   ///< number of particles that count, by bin
};

/// @param packing with lengths in mean diameters. @param range in the unit of the distance; times the largest r_i + r_j, if it is
/// by contact, no more than largest_pair_distance. @param bins equally wide over the range.
PairHistogram count_pairs(const Packing& packing, const SampleWindow& window, double range, Index bins, PairDistance distance);

/// The largest distance that the sample serves, in the unit of the packing: half the shortest length of a periodic cell; in an open
/// one the depth that a tenth of the particles have.
double largest_pair_distance(const Packing& packing, const SampleWindow& window);

}  // namespace coagula::characterize
