// SPDX-License-Identifier: GPL-3.0-or-later
// Oscillatory shear by explicit discrete elements: the rheometer of Schenker et al. 2012 (sec. 2.4), and homogeneous shear of a
// periodic cell.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/dem/particle_system.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace coagula::mechanics {

enum class RheometerBoundary {
    plates,   ///< layers of the periodic repetition below (fixed) and above (driven), periodic along the plates
    periodic  ///< no plates: the periodic cell is sheared
};

/// One oscillation of a course.
struct CourseOscillation {
    double part = 1;     ///< of the amplitude, above 0 and up to 1
    bool breaks = true;  ///< else its bonds hold whatever they carry: what it loses is the rate of the run
};

struct RheometerOptions {
    ContactModel model;
    RheometerBoundary boundary = RheometerBoundary::plates;
    double amplitude = 1e-3;                     ///< largest strain of an oscillation, > 0
    bool growing = true;                         ///< the k-th of n oscillations has k / n of the amplitude; else all have it
    std::vector<CourseOscillation> course = {};  ///< every oscillation instead; or empty
    int oscillations = 10;                       ///< > 0
    double frequency = 1;                        ///< [Hz], > 0; with scaled masses, see RheometerResult::mass_scaling
    int steps_per_oscillation = 6000;            ///< >= 100
    int samples_per_oscillation = 100;           ///< of the stress; >= 8, a multiple of 4 and a divisor of steps_per_oscillation
    double damping = 0.9;                        ///< alpha of the local damping, 0 <= alpha < 1
    double density = 3690;                       ///< of the particles [kg/m^3], > 0: what the scaled masses are compared with
    bool unstressed_as_found = true;             ///< bonds have no force where they are found; else at distance r_i + r_j
    double plate_layers = 3;                     ///< thickness of a plate in mean diameters
    int measurement_spheres = 5;                 ///< between the plates, from a fifth to four fifths of the height
    double measurement_radius = 0.2;             ///< of a measurement sphere over the height
    double rest_tolerance = 1e-9;  ///< relaxation ends at this rms force over (normal contact stiffness x mean radius) ...
    double rest_change = 1e-3;     ///< ... or when the rms force changes by less than this share within 100 steps
    Index most_rest_steps = 200000;
    bool compare_with_rest = true;  ///< measure RheometerRun::rate_error
};

/// One oscillation with amplitude gamma_0.
struct Oscillation {
    double amplitude = unset;            ///< of strain
    double storage_modulus = unset;      ///< |G*| cos(phase) [Pa], |G*| = largest stress / largest strain, as in the paper
    double loss_modulus = unset;         ///< |G*| sin(phase) [Pa]
    double phase = unset;                ///< of the fundamental of the stress before that of the strain [rad]
    double fundamental_storage = unset;  ///< G' and G'' of the fundamental alone [Pa]
    double fundamental_loss = unset;
    double third_harmonic = unset;  ///< amplitude of the third harmonic of the stress over the first
    double offset = unset;          ///< mean stress [Pa]
    Index broken_bonds = 0;         ///< in this oscillation
};

/// A bond that broke.
struct BrokenInShear {
    Index first;  ///< in the packing; a particle of a plate by the one that it repeats
    Index second;
    double strain;
    int oscillation;
    BreakageCause cause;
};

/// One orientation.
struct RheometerRun {
    ShearOrientation orientation;
    std::vector<Oscillation> oscillations;
    std::vector<double> strain;        ///< samples, all oscillations one after the other
    std::vector<double> stress;        ///< mean over the whole volume [Pa]
    std::vector<double> plate_stress;  ///< force on the driven plate over its area [Pa]; empty without plates
    Eigen::MatrixXd sphere_stress;     ///< samples x spheres [Pa]; no columns without plates
    Eigen::VectorXd sphere_storage;    ///< G' of the fundamental in the last oscillation, in each sphere [Pa]
    double plate_storage = unset;      ///< the same from the force on the plate [Pa]
    std::vector<BrokenInShear> broken;
    Index rest_steps = 0;             ///< of the relaxation before
    double rest_force = unset;        ///< rms unbalanced force left, over (normal contact stiffness x mean radius)
    double unbalanced_ratio = unset;  ///< rms unbalanced force over mean contact force at a further peak
    double rate_error = unset;    ///< relative: stress at a further peak minus the stress there after the network has come to rest
    double rest_modulus = unset;  ///< stress there after it has come to rest, over the strain: G' without any rate [Pa]
};

struct RheometerResult {
    std::vector<RheometerRun> runs;
    Index contacts = 0;                       ///< bonds of the packing
    double contact_normal_stiffness = unset;  ///< [N/m]; of unloaded Hertz contacts 0
    double contact_shear_stiffness = unset;
    double time_step = unset;        ///< [s]
    double mass_scaling = unset;     ///< mass of a particle in the run over its real mass
    double inertial_number = unset;  ///< largest strain rate x sqrt(mass / normal contact stiffness)

    /// Moduli of the last oscillation, as mean over the orientations and standard deviation [Pa].
    double storage_modulus() const;
    double storage_deviation() const;
    double loss_modulus() const;
    double loss_deviation() const;
    double phase() const;
};

/// Where a run stands after an oscillation; going on from it gives the same bits as not having stopped.
struct RheometerCheckpoint {
    std::vector<RheometerRun> finished;
    RheometerRun current;
    dem::ParticleState state;
};

struct RheometerControl {
    std::function<void(const RheometerCheckpoint&)> on_checkpoint;  ///< called after every oscillation, if given
    const RheometerCheckpoint* resume = nullptr;                    ///< go on from here
};

/// Shears `packing` with its `bonds` (periodic cell) in each of the orientations, each from the start.
///
/// Before the test the network relaxes by steps after each of which all velocities are set to zero, until the mean unbalanced force
/// is constant. The strain is amplitude x sin(2 pi frequency t), growing from oscillation to oscillation, at constant volume; local
/// damping as in the paper. Masses are scaled so that the stiffest motion takes a fixed part of a time step: the elastic response
/// has no rate, and `rate_error` tells what the rate in the run costs.
///
/// Stress is the mean over the volume between the plates (each bond counts with the part of it inside), the force on the driven
/// plate over its area, and that of measurement spheres (PFC3D: solid fraction in the sphere over the volume of the particles whose
/// centres lie in it, times the sum of lever x contact force).
///
/// Throws std::invalid_argument for impossible options, models that have no time-domain force (springpots) or an open cell;
/// std::runtime_error when positions run away.
RheometerResult run_rheometer(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options,
                              const std::vector<ShearOrientation>& orientations, const Progress& progress = {},
                              const RheometerControl& control = {});

}  // namespace coagula::mechanics
