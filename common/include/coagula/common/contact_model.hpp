// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact is made of: springs, strengths, friction, losses, ageing, and the solvent around it.
#pragma once

#include <coagula/common/checks.hpp>

#include <complex>
#include <span>
#include <string>

namespace coagula {

/// What a contact is made of. Springs are given per particle, two in series make a contact (PFC3D convention, Schenker et al.
/// 2012); every loss is one of the contact and acts beside the spring. What is unset is not there. Each parameter is described in
/// contact_parameters() and docs/reference/contact-model.md.
struct ContactModel {
    double normal_stiffness = 100;
    double shear_stiffness = 10;

    double normal_viscosity = unset;
    double shear_viscosity = unset;

    double normal_maxwell_stiffness = unset;
    double normal_maxwell_time = unset;
    double shear_maxwell_stiffness = unset;
    double shear_maxwell_time = unset;

    double normal_springpot_stiffness = unset;
    double normal_springpot_time = unset;
    double normal_springpot_exponent = unset;
    double shear_springpot_stiffness = unset;
    double shear_springpot_time = unset;
    double shear_springpot_exponent = unset;

    double solvent_viscosity = unset;
    double lubrication_gap = unset;
    double lubrication_cutoff = unset;

    double bending_stiffness = unset;
    double twisting_stiffness = unset;

    double young_modulus = unset;
    double poisson_ratio = unset;
    double work_of_adhesion = unset;

    double normal_strength = unset;
    double shear_strength = unset;
    double bending_strength = unset;
    double friction = unset;

    double prestress = unset;
    double ageing_rate = unset;
    double ageing_time = unset;
};

/// When a parameter plays a part.
enum class ContactRole {
    spring,  ///< always
    loss,    ///< in motion that takes time
    limit    ///< at finite strain or age: strengths, friction, ageing
};

/// One parameter of the model: name (the key in a file), SI unit, allowed values, meaning and source.
struct ContactParameter {
    std::string name;
    std::string unit;  ///< UDUNITS text
    double ContactModel::*value;
    double low;  ///< smallest value
    bool low_included;
    double high;  ///< largest value, included; infinite: any
    std::string meaning;
    std::string source;
    ContactRole role = ContactRole::spring;

    /// Whether the model has it.
    bool is_set(const ContactModel& model) const;
    /// Such as "> 0", ">= 0", "0 .. 1".
    std::string range() const;
};

/// All parameters, in the order of the struct.
std::span<const ContactParameter> contact_parameters();

/// Throws std::invalid_argument with a sentence that names the parameter, its value and the rule: a value out of range, the normal
/// stiffness missing, an element of which only a part is given (Maxwell, springpot, Hertz, lubrication, ageing), a strength that no
/// force can reach or that the prestress passes.
void check(const ContactModel& model);

/// Force over displacement of a contact at one frequency [N/m].
struct ContactStiffness {
    std::complex<double> normal;
    std::complex<double> shear;
};

/// k* = k / 2 + i w c + k_M i w t_M / (1 + i w t_M) + k_S (i w t_S)^a for each direction: spring (k of a particle, two in series),
/// dashpot (Kelvin-Voigt) and Maxwell element in parallel (Ferry 1980, Viscoelastic Properties of Polymers, ch. 3), springpot
/// (Koeller 1984, J. Appl. Mech. 51, 299). Time dependence e^{i w t}, so losses have a positive imaginary part.
/// @param angular_frequency w [rad/s], > 0.
ContactStiffness complex_stiffness(const ContactModel& model, double angular_frequency);

/// Derivative of k* by a parameter that the model has [N/m per unit of the parameter]; zero for one that does not enter, such as
/// the viscosity of the solvent.
ContactStiffness stiffness_derivative(const ContactModel& model, double angular_frequency, double ContactModel::*parameter);

/// Drag of a sphere in a viscous fluid over the viscosity (Stokes 1851; Happel and Brenner 1983, ch. 5): force over relative
/// velocity 6 pi r [m], and torque over relative angular velocity 8 pi r^3 [m^3]. Neighbours do not screen it.
double translation_drag(double radius);
double rotation_drag(double radius);

}  // namespace coagula
