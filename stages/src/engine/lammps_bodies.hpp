// SPDX-License-Identifier: GPL-3.0-or-later
// A bonded network as LAMMPS holds it: particles are rigid bodies, held together by central springs between points on them.
//
// LAMMPS has no bond that resists sliding. A contact's energy k_n/2 along the line of centres and k_s/2 across it is that of two
// springs: k_n - k_s between the centres, and one of length zero and stiffness k_s that holds together a point of each body at the
// contact. Further springs of length zero between points at a distance l from the contact turn into moments: a pair of stiffness k
// at +l e and -l e resists relative rotations across e by 2 k l^2, and sliding by 2 k, which the spring at the contact has less.
//
// Lengths are in mean radii and stiffnesses in the normal stiffness of a contact. The mass of an atom is the sum of its springs:
// no mode then has a frequency above sqrt(2), which is that of two equal masses on a spring of this stiffness.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace coagula::stages {

/// Stiffness of every contact, in its normal stiffness (shear) and that times the squared mean radius (moments).
struct ContactRatios {
    double shear = 0;
    double bending = 0;
    double twisting = 0;
};

/// The network under a strain that all particles follow without rotating.
struct LammpsBodies {
    std::string data;            ///< what read_data reads
    std::vector<double> masses;  ///< of the types of atoms, of which the first is 1
    bool turn = true;            ///< bodies have points beside their centres
    double reach = 0;            ///< of a bond, and from one point of a body to another
    Eigen::Matrix3d axes;        ///< columns: the axes of LAMMPS, in which its first edge lies along x and its second in xy
};

/// @param deformation of the cell and the centres, 1 + strain. Particles without bonds are left out.
LammpsBodies lammps_bodies(const Packing& packing, const ContactNetwork& bonds, const ContactRatios& ratios,
                           const Eigen::Matrix3d& deformation);

/// Commands that forget what was before and read `network.data` in the folder.
std::string lammps_bodies_setup(const LammpsBodies& bodies, const std::filesystem::path& folder);

/// Commands that move the bodies by so many steps under a drag, by which a free body loses its velocity at this rate, and write
/// the state into a file, which is there at once.
std::string lammps_settle(const LammpsBodies& bodies, double rate, std::int64_t steps, const std::filesystem::path& file);

/// Time between two steps.
inline constexpr double lammps_settling_step = 1.2;

/// The state at rest, as the file of lammps_settle() holds it.
struct LammpsRest {
    double energy = 0;       ///< of all springs
    Eigen::Matrix3d stress;  ///< tension is positive; in the axes of LAMMPS
};
LammpsRest read_lammps_rest(const std::filesystem::path& file);

}  // namespace coagula::stages
