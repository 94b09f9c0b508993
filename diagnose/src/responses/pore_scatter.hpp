// SPDX-License-Identifier: GPL-3.0-or-later
// Scatter of whole pore curves from structure to structure, estimated from one structure.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// Pore radii at which the scatter is known, from 0 in equal steps; over the mean particle radius.
constexpr Index scatter_radii = 31;
constexpr double scatter_step = 0.1;

/// Covariance of the exclusion probability at these radii between periodic structures as large as this one and of one volume
/// fraction: radii x radii, column by column.
///
/// The mean over a box is its wave of infinite length, and waves as long as the box have nearly the same variance: those along its
/// edges and the diagonals of its faces. What they have in common with those of the void fraction is taken out, as the volume
/// fraction of the whole does not vary.
std::vector<double> covariance_of_pores(const Packing& packing);

}  // namespace coagula::diagnose
