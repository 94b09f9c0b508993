// SPDX-License-Identifier: GPL-3.0-or-later
// Difference between the solvent drag in a large sample and in a few structures.
#pragma once

#include <Eigen/Core>

namespace coagula::diagnose {

/// How much the logarithm of the reduced viscosity (G* / G - 1 over i times the reduced drag) of a large sample exceeds that of
/// the mean of a few structures; a normal number.
struct DragScatter {
    Eigen::VectorXd excess;  ///< expected at the nodes
    Eigen::MatrixXd errors;  ///< nodes x independent standard errors
    double degrees;          ///< of freedom from which their common scale is known
};

/// Nearly floppy motions are few in a structure, and slow ones fewer. So the scatter falls with the reduced drag and with the
/// number of particles, and it is smooth along the logarithm of the drag. Where structures differ by factors, the mean of few lacks
/// those that lose most: its logarithm is expected below that of the mean of many by half the variance, and the variance is that of
/// a mean of lognormal numbers (Fenton, IRE Trans. Commun. Syst. 8 (1960) 57), as which the parts of a large structure count, too.
/// Structures alone say too little about it: two of them know one shape of many. Hence the stated scatter is that of 134 structures
/// by void expansion, and the structures at hand correct its scale.
///
/// @param drags reduced ones at the nodes, equally spaced in the logarithm.
/// @param particles mean number in a structure.
/// @param logarithms nodes x structures: of their reduced viscosities, less the mean of each group.
/// @param means number of groups that these are of.
/// @param averaged number of structures in the mean whose errors are asked for.
DragScatter drag_scatter(const Eigen::ArrayXd& drags, double particles, const Eigen::MatrixXd& logarithms, Eigen::Index means,
                         Eigen::Index averaged);

}  // namespace coagula::diagnose
