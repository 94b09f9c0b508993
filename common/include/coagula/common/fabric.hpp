// SPDX-License-Identifier: GPL-3.0-or-later
// Fabric: the directions of contacts, or of the forces they carry.
#pragma once

#include <coagula/common/contact_network.hpp>

#include <Eigen/Core>

namespace coagula {

/// Mean of n n^T over contacts, weighted or not (Satake 1982; Madadi et al. 2004); zero when there are none.
struct Fabric {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();       ///< trace 1
    Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();  ///< ascending
    double anisotropy = 0;                                  ///< sqrt(3/2) |tensor - 1/3|: 0 isotropic, 1 all contacts parallel
};

/// @param weight one per contact, >= 0 (such as |f_n|; all ones for the fabric of the contacts).
Fabric find_fabric(const ContactNetwork& bonds, const Eigen::VectorXd& weight);

}  // namespace coagula
