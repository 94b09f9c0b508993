// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts of a packing in a periodic cell under simple shear or uniaxial strain, with their memories: forces, stress and energy
// for a trial motion. Motions are in reduced units: six numbers per particle, displacement beyond the affine one in mean radii,
// then rotation.
#pragma once

#include "solvers/stiffness.hpp"

#include <coagula/common/general_contact.hpp>
#include <coagula/mechanics/quasistatic.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

using Motion = Eigen::VectorXd;

/// Force and the moments on both particles of a contact, on the first: (force, moment on first, moment on second), reduced.
using Wrench = Eigen::Matrix<double, 9, 1>;

/// Derivatives of a wrench by (branch, rotation of first, rotation of second), reduced; minus the moments' rows, so that an elastic
/// contact has a symmetric one.
using Slope = Eigen::Matrix<double, 9, 9>;

/// Relative motions in which a contact has stiffness, as columns: three displacements at the contact point, of bonds with moments
/// also three relative rotations.
using ContactModes = Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, 6>;

/// A pair that is bonded, or near enough to touch soon.
struct ShearedContact {
    Index first = 0;
    Index second = 0;
    Index bond = -1;  ///< column in the network of bonds, -1: never was one
    ContactMemory memory;
};

/// State of all contacts after a trial motion.
struct Trial {
    double strain_increment = 0;
    Motion motion;
    std::vector<ContactMemory> memory;
    std::vector<Wrench> wrench;
    Motion residual;  ///< force and moment on every particle, reduced
    double dissipated = 0;
    double rms_residual = 0;  ///< over the particles
    double rms_force = 0;     ///< over the contacts that carry any
};

class ShearedNetwork {
public:
    ShearedNetwork(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                   const QuasistaticOptions& options);

    Index particles() const { return positions_.cols(); }
    const std::vector<ShearedContact>& contacts() const { return contacts_; }
    double strain() const { return strain_; }
    /// Volume before the strain [m^3]. The Cauchy stress times this volume is the work per strain, because shear keeps the volume
    /// and uniaxial strain keeps the area of the plates.
    double volume() const { return volume_; }

    /// Forces after a strain increment and a motion since the committed state.
    void evaluate(double strain_increment, const Motion& motion, Trial& trial) const;

    std::vector<Slope> linearise(const Trial& trial) const;
    /// The tangent of the k-th contact at a trial motion.
    Slope slope_of(Index k, const Trial& trial) const;
    /// @param turns with relative rotations.
    ContactModes modes_of(Index k, const Trial& trial, bool turns) const;
    bool has_moments() const { return law_.model().bending_stiffness > 0 || law_.model().twisting_stiffness > 0; }
    /// Grows when neighbours are looked for, after which the contacts are numbered anew.
    Index generation() const { return generation_; }

    /// Affine change of a branch per strain, in mean radii.
    Eigen::Vector3d strain_rate(const ContactMemory& memory) const;

    /// Makes a trial the committed state; looks for new neighbours when particles have moved far enough. Returns whether pairs
    /// were found that touch already and push.
    bool commit(const Trial& trial);

    /// How far a motion may go before neighbours must be looked for, as a fraction of what is left; above 1 contacts may be missed.
    double reach_used(double strain_increment, const Motion& motion) const;

    /// Largest load of the bonds, and which contact has it (-1: none).
    struct Worst {
        double ratio = 0;
        BreakageCause limit = BreakageCause::normal;
        Index contact = -1;
    };
    Worst most_loaded(const std::vector<ContactMemory>& memory) const;
    /// The part of the way to these memories at which the first bond reaches its strength, if loads grow in proportion. Above 1
    /// none does.
    double first_to_break(const std::vector<ContactMemory>& memory) const;
    std::vector<ContactMemory> memories() const;

    void break_bond(Index contact);

    /// Energy in the contacts [J].
    double energy(const std::vector<ContactMemory>& memory) const;
    /// Energy and dissipation of a trial in units of the contact stiffness and the mean radius squared.
    double reduced_energy(const Trial& trial) const;
    /// What rounding leaves of the energy of a network without load [J].
    double least_energy() const { return 1e-20 * static_cast<double>(particles()) * stiffness_ * length_ * length_; }
    Eigen::Matrix3d stress(const Trial& trial) const;
    Index intact_bonds() const;
    /// Whether bonds and touching contacts reach around the cell along the plate normal. If not, a plane parallel to the plates can
    /// be bent so that nothing crosses it, and there is no stress on the plates.
    bool spans() const;
    Index touching_contacts() const;

    /// Makes all springs `factor` times as stiff as at the start, new stiffness unstressed; returns the energy lost [J].
    double age(double factor);

private:
    PairMotion pair_motion(const ShearedContact& contact, double strain_increment, const Motion& motion) const;
    Wrench wrench(const ContactMemory& memory, const ContactForce& force, const ShearedContact& contact) const;
    double difference_step(const ContactMemory& memory) const;
    void gather(Trial& trial) const;
    Packing before_strain(double strain) const;
    void find_neighbours();
    const ShearedContact* find_contact(Index first, Index second, const Eigen::Vector3d& branch) const;
    void group_contacts();
    /// A branch at the strain `from` after an increment more.
    Eigen::Vector3d strained(const Eigen::Vector3d& branch, double from, double increment) const;
    /// How many times as large distances may be before a strain as after it.
    double stretch_of_distances(double strain) const;
    /// Height of the cell along the normal over that before the strain.
    double relative_height(double strain) const { return orientation_.is_uniaxial() ? 1 + strain : 1.0; }

    GeneralContact law_;
    ShearOrientation orientation_;
    Cell cell_;  ///< before the strain
    double volume_;
    double length_;     ///< unit of length: mean radius [m]
    double stiffness_;  ///< unit of stiffness [N/m]
    Eigen::Matrix3Xd positions_;
    Eigen::VectorXd radii_;
    double strain_ = 0;
    std::vector<ShearedContact> contacts_;
    Index bonds_ = 0;  ///< the first of the contacts are the bonds, broken or not
    ContactsByParticle groups_;
    Eigen::Matrix3Xd moved_;  ///< beyond the affine motion, since neighbours were looked for, in mean radii
    double strain_at_search_ = 0;
    Index generation_ = 0;
};

}  // namespace coagula::mechanics
