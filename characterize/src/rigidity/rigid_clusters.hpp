// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid clusters of particles from random floppy motions.
#pragma once

#include <coagula/characterize/rigidity.hpp>

namespace coagula::characterize {

/// Finds the rigid clusters of normal-and-shear bonds. @param motions 6 N x K, displacements and rotations in mean radii
/// (rigidity_matrix.hpp). `self_stress` is left empty.
RigidClusters find_rigid_clusters(const Packing& packing, const ContactNetwork& contacts, const Eigen::MatrixXd& motions,
                                  double tolerance);

}  // namespace coagula::characterize
