// SPDX-License-Identifier: GPL-3.0-or-later
// The measured numbers, one by one.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include "repeated_images.hpp"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace coagula::diagnose {

/// One number that was measured.
struct Observation {
    std::size_t measurement = 0;
    std::size_t row = 0;
    bool loss = false;              ///< G'', else G'
    double value = 0;               ///< [Pa]
    double standard_error = unset;  ///< [Pa]; NaN where the table has none
    // Errors of torque and phase lie along and across G*: those of its two parts, each turned by at most 45 degrees.
    bool of_phase = false;   ///< the error is that of the phase, or of a loss modulus alone; else of the torque
    double turned = 0;       ///< from the axis of G' to that of its error, towards G'' [rad]
    double other_error = 0;  ///< of the other part of G*, as turned [Pa]
    // Conditions of the row; NaN where the table does not state them.
    double strain = unset;              ///< amplitude
    double set_strain = unset;          ///< the same where it was set; of a run under a set stress that, as a strain
    double largest_strain = unset;      ///< that the sample has seen up to this row
    double angular_frequency = unset;   ///< [rad/s]
    double time = unset;                ///< on the clock of the sample (run_clock.hpp) [s]
    double age = unset;                 ///< the same since the last shear that destroyed the structure [s]
    double place = unset;               ///< among all rows of all runs, 0 .. 1, sample by sample in their order
    double sample_place = unset;        ///< where the first row of its sample is
    double shear_rate = unset;          ///< of steady flow [1/s], where the value is a viscosity [Pa.s]; else NaN
    double gap = unset;                 ///< [m]
    double plate_radius = unset;        ///< [m]
    double torque_per_modulus = unset;  ///< torque per deflection over the modulus [m^3]
    double cone_angle = unset;          ///< [rad]; NaN where there is no cone
    double normal_force = unset;        ///< that pushes the plates apart [N]
    ErrorLaw errors = {};               ///< of the errors, torque or phase
    bool third_harmonic = false;        ///< of the stress over the first, elastic or viscous part, in place of a modulus
    bool rough_plates = false;
    bool solvent_trap = false;
    int run = 0;                     ///< its place among those on the sample (run_clock.hpp)
    double fluid_viscosity = unset;  ///< of a Newtonian fluid in place of the sample [Pa.s]
    // Members for a structure series.
    std::size_t structures = 0;  ///< group that stands for the row; 0: all structures
    double heterogeneity = unset;
    double coordination = unset;
    double volume_fraction = unset;
    // Of coordinates: the value is the mean number of neighbours in consecutive shells of a direction, the first of which is the
    // row ...
    double distance = unset;  ///< middle of the shells over the diameter
    std::size_t shells = 1;
    // ... or what differs between images of the same particles; rows after those of the shells.
    std::optional<ImageDifference> difference = {};
    double centres = 0;  ///< whose neighbours were counted, or that are compared
    double mutual = 0;   ///< share of the neighbours that are centres, too
    // Of a pore curve: the value is the share of the void space farther from any surface than this.
    double pore_radius = unset;  ///< [m]
};

/// "storage_modulus", "loss_modulus", "viscosity", "third_harmonic_storage", "third_harmonic_loss", "neighbours_plane",
/// "neighbours_axis", "exclusion_probability", "localisation_plane", "localisation_axis" or "unmatched_share".
const char* observable_of(const Observation& observation);

/// Whether the observation is a viscosity of steady flow.
inline bool is_steady(const Observation& observation) {
    return std::isfinite(observation.shear_rate);
}

/// Whether a Newtonian fluid is in place of the sample.
inline bool is_fluid(const Observation& observation) {
    return std::isfinite(observation.fluid_viscosity);
}

/// A modulus, and not what was counted of the structure.
bool is_modulus(const Observation& observation);

/// What a difference in this observation is measured against where the expectation is `level`: that, but neighbours against one
/// neighbour at least and everything else as it stands.
double relative_to(const Observation& observation, double level);

/// What images of the same particles, so many centres each, would show: the values are still to be measured.
std::vector<Observation> planned_images(std::size_t measurement, double centres);

/// The moduli of all tables of moduli, row by row, cells that were left out skipped; then what tables show of the structure.
std::vector<Observation> observations_of(const Experiment& experiment);

/// |G*| at each observation of these moduli [Pa]; 1 at a third harmonic and between images.
Eigen::ArrayXd complex_moduli(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli);

}  // namespace coagula::diagnose
