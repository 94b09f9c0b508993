// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that a simulation of the sample can be run with: contacts, structures and their images.
#pragma once

#include <coagula/common/contact_model.hpp>

#include <compare>
#include <limits>

namespace coagula::diagnose {

/// Changes of the recipe of the experiment with which structures are made again.
struct StructureChange {
    double size_deviation = 0;  ///< standard deviation of the radii over their mean, of lognormal sizes
    double surface_potential = std::numeric_limits<double>::infinity();  ///< of coagulation [V]; infinite: as the recipe says
    double ionic_strength = 1;                                           ///< over that of the recipe
    double volume_fraction = 0;                                          ///< relative change of that of the sample
    double coordination = std::numeric_limits<double>::infinity();       ///< aimed at; infinite: as the recipe says
    double voids = std::numeric_limits<double>::infinity();              ///< per particle; infinite: as the recipe says

    // NOLINTNEXTLINE(modernize-use-nullptr): clang 14 takes the zero of a defaulted comparison for a pointer
    auto operator<=>(const StructureChange&) const = default;
};

/// One state of the simulation. The defaults are the base model of Schenker et al. 2012: linear normal and shear springs, bonds
/// without moments, no loss.
struct Settings {
    double normal_stiffness = 100;  ///< of a particle [N/m]
    double stiffness_ratio = 0.1;   ///< shear over normal stiffness
    double bending_ratio = 0;       ///< bending and twisting stiffness of a contact over its normal stiffness times r0^2
    double bond_tolerance = 0.01;   ///< pairs nearer than (1 + tolerance) (r_i + r_j) are bonded

    double springpot_ratio = 0;     ///< springpot of a contact over its spring at 1 Hz, in both directions
    double springpot_exponent = 0;  ///< 0 .. 1
    double dashpot_time = 0;        ///< viscosity of a contact over its stiffness, in both directions [s]
    double relaxing_ratio = 0;      ///< spring of the Maxwell element of a contact over its own, in both directions
    double relaxation_time = 0;     ///< of that element [s]

    double felt_viscosity = 0;  ///< of the solvent as the particles feel it: drag 6 pi eta r against the affine flow [Pa.s]

    double critical_strain =
        std::numeric_limits<double>::infinity();  ///< bond strength, normal and shear, over k_n r0 of a contact

    double rim_critical_strain = std::numeric_limits<double>::infinity();  ///< the same where the strain between plates grows along
                                                                           ///< the radius; the smaller of both counts
    double strength_per_decade = 0;  ///< by which both grow with each decade of the frequency beyond 1 Hz, where they are stated

    double tension = 0;  ///< force at rest that pulls in every contact, over its normal stiffness times the diameter

    double contact_preload = 0;  ///< Hertz contacts that are as stiff as the springs at this overlap over r0, which they have under
                                 ///< the load at rest; 0: linear springs

    double localisation_plane = 0;  ///< standard deviation of measured centres in the plane x-y [m]
    double localisation_axis = 0;   ///< along z [m]
    double missed_share = 0;        ///< of the particles
    double false_share = 0;         ///< of the centres: points where no particle is

    StructureChange structures = {};  ///< none: as they are

    bool operator==(const Settings&) const = default;
};

/// Contact model of a simulation; of Hertz contacts without their load at rest, which a force that no solver has would balance.
/// @param radius mean radius of the particles [m].
ContactModel contact_model_of(const Settings& settings, double radius);

}  // namespace coagula::diagnose
