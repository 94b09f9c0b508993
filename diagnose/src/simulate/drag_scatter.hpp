// How far the drag of a solvent in a large sample can be from that in a few structures.
#pragma once

#include <Eigen/Core>

namespace coagula::diagnose {

/// Relative errors of the mean reduced viscosity (G* / G - 1 over i times the reduced drag) of a few structures.
struct DragScatter {
    Eigen::MatrixXd errors;  ///< nodes x independent standard errors
    double degrees;          ///< of freedom from which their common scale is known
};

/// Nearly floppy motions are few in a structure, and slow ones fewer. So the scatter falls with the reduced drag and with the number
/// of particles, and it is smooth along the logarithm of the drag. Structures alone say too little about it: two of them know one
/// shape of many. Hence the stated scatter is that of 134 structures by void expansion, and the structures at hand correct its scale.
///
/// @param drags reduced ones at the nodes, equally spaced in the logarithm.
/// @param particles mean number in a structure.
/// @param logarithms nodes x structures: of their reduced viscosities, less the mean of each group.
/// @param means number of groups that these are of.
/// @param averaged number of structures in the mean whose errors are asked for.
DragScatter drag_scatter(const Eigen::ArrayXd& drags, double particles, const Eigen::MatrixXd& logarithms, Eigen::Index means,
                         Eigen::Index averaged);

}  // namespace coagula::diagnose
