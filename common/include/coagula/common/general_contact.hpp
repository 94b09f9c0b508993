// SPDX-License-Identifier: GPL-3.0-or-later
// The contact law with all terms of the contact model in the time domain: one law for the explicit and the quasi-static solver.
#pragma once

#include <coagula/common/contact_memory.hpp>
#include <coagula/common/contact_model.hpp>

#include <Eigen/Core>

namespace coagula {

/// Normal force of a contact and its derivatives at one overlap.
struct NormalResponse {
    double force = 0;            ///< [N], positive when it pushes the particles apart
    double stiffness = 0;        ///< d force / d overlap [N/m]
    double energy = 0;           ///< since rest [J]
    double shear_stiffness = 0;  ///< of the contact at this overlap [N/m]
};

/// Forces of a contact on its first particle; the second feels the opposite force and moment.
struct ContactForce {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< at the contact point [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< couple besides [N m]
    /// Since the memory was last brought up to date: friction, micro-slip, dashpots [J]. The work of the forces in springs and
    /// friction is counted by the trapezium rule, mean of the forces before and after times motion.
    double dissipated = 0;
};

/// Stiffness of a contact for small further motion, the losses aside.
struct ContactTangent {
    double normal = 0;    ///< [N/m]
    double shear = 0;     ///< [N/m]
    double bending = 0;   ///< [N m]
    double twisting = 0;  ///< [N m]
    double tension = 0;   ///< -(normal force) / distance, the geometric stiffness across the line of centres [N/m]
};

/// Which limit a bond reached; bending is the larger of bending and twisting moment, pull-off the end of a JKR law. The numbers are
/// those in result files.
enum class BreakageCause { normal = 0, shear = 1, bending = 2, pull_off = 3 };

/// How near a bond is to breaking.
struct BondLoad {
    double ratio = 0;                             ///< to the limit; above 1 the bond breaks
    BreakageCause limit = BreakageCause::normal;  ///< that is nearest
};

/// Law of one contact, bonded or not, for a contact model.
///
/// Normal force by overlap U = rest length - distance: k_n U; or with `young_modulus` Hertz's 4/3 E* sqrt(R*) U^(3/2); or with
/// `work_of_adhesion` that of Johnson, Kendall and Roberts, measured from its own overlap at rest, so that a bond of rest length d
/// carries no force at d. Bonds act both ways (Hertz's law continues as an odd function), other contacts push only.
/// Shear force k_s s; with `young_modulus` Mindlin's 8 G* (contact radius), where a change of stiffness loses energy as in
/// Elata and Berryman (Mech. Mater. 24, 1996, 229): unloading keeps s, loading keeps the force. JKR's law ends at the overlap of
/// pull-off at controlled distance; a bond that has not yet been broken there keeps its last force.
/// Bonds pass moments k_b (bending) and k_t (twisting) times relative rotation, and break at the strengths.
/// Contacts without a bond slip at friction x normal force.
/// Dashpots and Maxwell elements act beside the springs, in bonds and other contacts.
class GeneralContact {
public:
    /// Throws std::invalid_argument for an impossible model and for springpots, whose force has no finite memory.
    explicit GeneralContact(const ContactModel& model);

    const ContactModel& model() const { return model_; }

    /// All springs are `factor` times as stiff from now on; see reage(). > 0.
    void set_age_factor(double factor);
    double age_factor() const { return age_; }

    /// Memory of a new bond between particles `branch` apart that carries the model's prestress.
    /// @param unstressed_distance centre distance without normal force if there were no prestress [m]: r_i + r_j, or the distance
    /// as found. Throws std::invalid_argument for a tensile prestress that adhesion cannot bear.
    ContactMemory make_bond(const Eigen::Vector3d& branch, double first_radius, double second_radius,
                            double unstressed_distance) const;
    /// Memory of a contact that is just being made, without a bond.
    ContactMemory make_contact(const Eigen::Vector3d& branch, double first_radius, double second_radius) const;

    /// Normal response. @param effective_radius r_i r_j / (r_i + r_j) [m]
    NormalResponse normal(double overlap, double effective_radius, bool bonded) const;

    /// Brings the memory up to date with a motion and returns the forces after it.
    /// @param duration of the motion [s] for dashpots and Maxwell elements; 0: they take no part, as in infinitely slow motion.
    ContactForce update(ContactMemory& memory, const PairMotion& motion, double duration) const;

    /// Energy in the springs [J]; those of Maxwell elements included.
    double energy(const ContactMemory& memory, double first_radius, double second_radius) const;

    ContactTangent tangent(const ContactMemory& memory, double first_radius, double second_radius) const;

    /// Largest ratio of tension, shear force and moment of the springs to its strength; 0 without a strength and for contacts
    /// without a bond. A JKR bond also breaks where its law ends (pull-off at controlled distance).
    BondLoad load(const ContactMemory& memory, double first_radius, double second_radius) const;

    /// Breaks the bond: what remains, at the same rest length, is a touching contact within the limit of friction, or nothing.
    /// Returns the energy lost [J].
    double break_bond(ContactMemory& memory, double first_radius, double second_radius) const;

    /// Changes the memory from stiffness factor `before` to the present one without changing any force: new stiffness grows
    /// unstressed. Returns the energy lost [J].
    double reage(ContactMemory& memory, double before, double first_radius, double second_radius) const;

    /// Whether to keep the memory: false for a contact without a bond that has parted, both from its rest length (that of a broken
    /// bond may differ from the sum of radii) and from where make_contact() would begin a new one.
    static bool touches(const ContactMemory& memory, double first_radius, double second_radius);

private:
    struct Jkr;
    NormalResponse hertz(double overlap, double effective_radius) const;
    NormalResponse jkr(double overlap, double effective_radius) const;
    double overlap_under(double force, double effective_radius, bool bonded) const;
    bool is_hertzian() const { return contact_modulus_ > 0; }
    static void follow_stiffness(ContactMemory& memory, double now);
    static void limit_shear(ContactMemory& memory, double limit);
    Eigen::Vector3d losses(ContactMemory& memory, const ContactIncrement& increment, double duration, double& dissipated) const;

    ContactModel model_;
    double age_ = 1;
    double normal_stiffness_ = 0;  ///< of the contact [N/m]
    double shear_stiffness_ = 0;
    double contact_modulus_ = 0;  ///< E* [Pa]; 0: linear springs
    double shear_modulus_ = 0;    ///< G* [Pa]
    double adhesion_ = 0;         ///< W [J/m^2]
};

}  // namespace coagula
