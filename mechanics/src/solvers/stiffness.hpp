// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness matrix of a bonded network and its loads, in reduced units: lengths in the mean radius, stiffness in the normal
// contact stiffness, rotations as arc length on the mean radius. Six unknowns per particle: displacement, then rotation.
#pragma once

#include "load_bearing.hpp"

#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

namespace coagula::mechanics {

using Block = Eigen::Matrix<double, 6, 6>;
using Loads = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;  ///< one column per unit strain

/// A bond with all that the linear kinematics needs. It stores 1/2 [k_n (delta.n)^2 + k_s |delta_t|^2 + k_b |bend_t|^2 + k_t
/// (bend.n)^2
/// + tension |moved_t|^2], t the part across n, with
///     moved = u_j - u_i + strain * branch,
///     delta = moved + [n]x (R_i theta_i + R_j theta_j), the displacement at the contact,
///     bend = theta_j - theta_i.
struct LinearBond {
    Index first;  ///< numbered among the load-bearing particles; -1: held, follows the strain without rotating
    Index second;
    Eigen::Vector3d normal;  ///< unit vector from first to second
    Eigen::Vector3d branch;  ///< in mean radii; or what the strain acts on instead, see LinearNetwork::strain
    double first_arm;        ///< distance from the centre to the contact point, in mean radii
    double second_arm;
    ContactTangent tangent;  ///< reduced
};

/// Deformations of a bond, as columns: delta, bend and moved of LinearBond.
template <int Columns>
using Deformations = Eigen::Matrix<double, 9, Columns>;

/// Derivative of the energy by the deformation: force at the contact, moment, and force of the tension that turns with the bond.
template <int Columns>
Deformations<Columns> stresses(const LinearBond& bond, const Deformations<Columns>& deformation) {
    const ContactTangent& k = bond.tangent;
    const Eigen::Vector3d& n = bond.normal;
    const auto part = [&](Index first, double along, double across) -> Eigen::Matrix<double, 3, Columns> {
        const auto rows = deformation.template middleRows<3>(first);
        return across * rows + ((along - across) * n) * (n.transpose() * rows);
    };
    Deformations<Columns> result;
    result << part(0, k.normal, k.shear), part(3, k.twisting, k.bending), part(6, 0, k.tension);
    return result;
}

/// Symmetric matrix of 6 x 6 blocks, upper triangle by rows, the diagonal block first in each row.
struct BlockMatrix {
    std::vector<Index> start;   ///< rows + 1
    std::vector<Index> column;  ///< column >= row
    std::vector<Block> block;

    Index rows() const { return static_cast<Index>(start.size()) - 1; }
    Block& diagonal(Index row) { return block[static_cast<std::size_t>(start[static_cast<std::size_t>(row)])]; }
};

/// The linear problem of one network.
class LinearNetwork {
public:
    /// @param tangents of all bonds of `network`. @param reference the stiffness that counts as 1 [N/m].
    LinearNetwork(const Packing& packing, const ContactNetwork& network, const LoadBearing& kept,
                  std::span<const ContactTangent> tangents, double reference);
    /// @param bonds of so many particles, in reduced units.
    LinearNetwork(Index particles, std::vector<LinearBond> bonds) : particles_(particles), bonds_(std::move(bonds)) {}

    /// Lets the strain act on `strained` (3 x bonds of the network given to the constructor [m]) instead of on the branch vectors:
    /// where held particles do not follow it.
    void strain(const Eigen::Matrix3Xd& strained);

    Index particles() const { return particles_; }
    const std::vector<LinearBond>& bonds() const { return bonds_; }

    /// K, without any shift.
    BlockMatrix stiffness() const;

    /// Minus the force on every unknown when all particles follow unit strain k (Voigt xx yy zz yz xz xy) affinely; column k.
    Loads loads() const;

    /// Twice the energy of affine motion, sum over bonds of e_a . stress_b.
    Block affine_energy() const;

    /// Twice the energy at the unknowns `motion`, sum over bonds of deformation_a . stress_b: the elastic tensor times the volume
    /// when the motion is that of equilibrium, correct to second order in its error. Bond by bond, because the motion of soft modes
    /// is large and would cancel in f u and u K u.
    Block energy(const Loads& motion) const;

    /// Sum over bonds of weight * e_a . t_b, e the affine deformations, t the stresses at the unknowns `motion`: the volume times
    /// the mean stress.
    Block virial(const Loads& motion, const std::vector<double>& weight) const;

    /// Deformation of a bond under the six unit strains at the unknowns `motion`.
    static Deformations<6> deformation(const LinearBond& bond, const Loads& motion);
    /// Deformation of a bond under the six unit strains when all particles follow the strain and none turns.
    static Deformations<6> affine_deformations(const LinearBond& bond);

    /// Adds stiffness to the spin of every particle with just two bonds about the line through its two contact points where nothing
    /// resists it: bonds without moment, or without twisting stiffness and on one line. No load works on that spin, so a
    /// preconditioner made of the result acts on the loads as K does. Returns how many such particles there are.
    Index stiffen_spins(BlockMatrix& matrix) const;

private:
    static void add_to_diagonal(BlockMatrix& matrix, const LinearBond& bond);
    static Block coupling(const LinearBond& bond);

    Index particles_ = 0;
    double length_ = 1;  ///< the mean radius [m]
    std::vector<Index> kept_bond_;
    std::vector<LinearBond> bonds_;
};

/// Relative displacements e = strain * branch of the six unit strains, as columns (3 x 6).
Eigen::Matrix<double, 3, 6> affine_displacements(const Eigen::Vector3d& branch);

/// y = K x for all columns at once; rows in parallel, the same bits for any number of threads.
void multiply(const BlockMatrix& full, const Loads& x, Loads& y);

/// Both triangles of a symmetric matrix, so that rows can be multiplied independently.
BlockMatrix both_triangles(const BlockMatrix& upper);

}  // namespace coagula::mechanics
