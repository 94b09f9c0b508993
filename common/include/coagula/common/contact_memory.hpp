// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact remembers, and how motion of its two particles changes that: the kinematics that all contact laws share.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace coagula {

/// Memory of a contact. Vectors are in the laboratory frame and turn with the pair.
struct ContactMemory {
    double rest_length = 0;                             ///< centre distance without normal force [m]
    bool bonded = true;                                 ///< else a touching contact with friction
    double shear_stiffness = 0;                         ///< when the shear displacement was last brought up to date [N/m]
    Eigen::Vector3d branch = Eigen::Vector3d::Zero();   ///< centre of second minus centre of first, at that time [m]
    Eigen::Vector3d shear = Eigen::Vector3d::Zero();    ///< elastic shear displacement of second against first [m]
    Eigen::Vector3d bend = Eigen::Vector3d::Zero();     ///< rotation of second against first, bending and twisting [rad]
    Eigen::Vector3d maxwell = Eigen::Vector3d::Zero();  ///< displacement held by the springs of the Maxwell elements [m]
    Eigen::Vector3d dashpot = Eigen::Vector3d::Zero();  ///< force of the dashpots in the motion before [N]
};

/// Motion of a pair since its memory was last brought up to date.
struct PairMotion {
    Eigen::Vector3d branch;      ///< now [m]
    Eigen::Vector3d first_turn;  ///< rotation of the first particle since then [rad]
    Eigen::Vector3d second_turn;
    double first_radius;  ///< [m]
    double second_radius;
};

/// What moved: displacement of second against first at the contact point, and the turn of the pair.
struct ContactIncrement {
    Eigen::Vector3d displacement;  ///< with its normal part [m]
    Eigen::Vector3d shear_growth;  ///< of the shear displacement, beyond its turn with the pair [m]
    Eigen::Vector3d normal;        ///< unit vector from first to second, now
    double distance = 0;           ///< of the centres, now [m]
    double first_lever = 0;        ///< distances of the contact point from the centres, now [m]
    double second_lever = 0;
};

/// Brings branch, shear, bend and maxwell (without its relaxation) up to date (Cundall and Strack 1979; eq. 2 of Schenker et al.
/// 2012): stored vectors turn with the contact plane and with the spin of the pair about its axis, the shear displacement grows by
/// the tangential motion at the contact point, which divides the line of centres in the ratio of the radii, and the bend by the
/// relative rotation. All is taken at the middle of the motion, so a rigid rotation by an angle t adds an error of order t^3 only.
/// Coincident centres must not occur.
ContactIncrement advance(ContactMemory& memory, const PairMotion& motion);

}  // namespace coagula
