// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static non-linear shear and uniaxial compression of a bonded packing: a path of equilibria in a deforming periodic cell,
// with breaking bonds, friction and large strain.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace coagula::mechanics {

/// Centre distance at which a bond would carry no force if the model had no prestress.
enum class RestLength {
    as_found,  ///< the distance in the packing, as in the linear solver
    touching,  ///< r_i + r_j; the packing is brought to equilibrium first
};

struct QuasistaticOptions {
    ShearOrientation orientation = {};  ///< of a shear, or the axis of a uniaxial strain
    RestLength rest_length = RestLength::as_found;
    double tolerance = 1e-7;          ///< rms force left on a particle over the largest rms contact force so far, > 0
    double balance_tolerance = 1e-6;  ///< of work against energy in every step, over peak stress x strain step x volume, > 0
    double event_tolerance = 1e-9;    ///< of the strain at which a bond breaks, over the largest strain of the run, > 0
    double smallest_step = 2e-3;  ///< of strain over the largest strain of the run; where no smaller step helps, the network has
                                  ///< lost its stability and jumps to another equilibrium at constant strain; > 0
};

/// An equilibrium on the path. Energies are summed from the start: work = (stored - stored at the start) + dissipated + breakage +
/// released, but for the error of integration.
struct StrainPoint {
    double strain = 0;  ///< of shear, or change of length over that before along the axis of a uniaxial strain
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  ///< Cauchy, sum of branch x force over the volume, tension > 0 [Pa]
    double work = 0;                                   ///< done by the boundary: trapezoidal sum of volume * stress d strain [J]
    double stored = 0;                                 ///< in the contacts [J]
    double dissipated = 0;                             ///< friction, micro-slip, and what ageing loses [J]
    double breakage = 0;                               ///< set free when bonds broke, the recoil of the network included [J]
    double released = 0;                               ///< set free where the network jumped without a bond breaking [J]
    Index bonds = 0;                                   ///< intact
    Index contacts = 0;                                ///< touching pairs without a bond

    /// work - (stored - start) - dissipated - breakage - released [J].
    double imbalance(const StrainPoint& start) const;
};

struct BrokenBond {
    Index bond = 0;  ///< column in the network of bonds
    double strain = 0;
    BreakageCause cause = BreakageCause::normal;
    bool follows = false;  ///< broke in a cascade, at the strain at which another bond broke
    Index section = 0;     ///< of a sweep: which amplitude
};

struct SolverEffort {
    Index steps = 0;
    Index jumps = 0;           ///< to another equilibrium without a bond breaking
    Index factorisations = 0;  ///< of the stiffness matrix
    Index solutions = 0;       ///< with a factor
    Index evaluations = 0;     ///< of all contact forces
};

/// After bonds broke the network no longer carries load.
struct NetworkFailure {
    double strain = 0;
    Index broken = 0;  ///< bonds so far
    /// No chain of contacts reaches around the cell along the plate normal, so that nothing can pass a stress on: the run ends. Not
    /// so under uniaxial compression, which brings the parts together again. Otherwise the chains that are left are floppy: from
    /// here to the end of a ramp less than a thousandth of the peak stress; the ramp ends early where what is left has no further
    /// equilibrium that is found.
    bool parted = true;
};

struct RampOptions {
    double strain = unset;  ///< at the end; not 0, negative for the other direction or, above -1, for uniaxial compression
    Index steps = 50;       ///< >= 1; equally spaced, smaller ones where needed
    QuasistaticOptions solver = {};
};

struct RampResponse {
    std::vector<StrainPoint> points;  ///< all equilibria; points at equal strain before and after bonds broke
    std::vector<BrokenBond> broken;
    std::optional<NetworkFailure> failure;
    SolverEffort effort;

    /// (stress on the plates - that at the start) / strain of one point [Pa]. @param orientation that of the run.
    double secant_modulus(std::size_t point, const ShearOrientation& orientation) const;
};

struct SweepOptions {
    std::vector<double> amplitudes = {};  ///< of strain, in the order of the run, > 0; such as up and down again
    Index cycles = 1;                     ///< per amplitude, >= 1; the last one is measured
    Index steps_per_cycle = 32;           ///< >= 4, a multiple of 4; equally spaced in phase
    double frequency = unset;             ///< [Hz]; how much time passes in a cycle, for ageing only
    QuasistaticOptions solver = {};
};

/// The last cycle at one amplitude.
struct AmplitudeResponse {
    double amplitude = 0;
    double storage_modulus = 0;  ///< fundamental of the stress, in phase with the strain, over the amplitude [Pa]
    double loss_modulus = 0;     ///< the same, in phase with the rate [Pa]
    double loop_area = 0;        ///< of stress against strain; pi amplitude^2 loss_modulus [J/m^3]
    double third_harmonic = 0;   ///< of the stress over its fundamental
    double peak_stress = 0;      ///< largest |stress| [Pa]
    std::vector<StrainPoint> loop;
    Index broken = 0;          ///< bonds, in all cycles at this amplitude
    Index bonds = 0;           ///< intact at the end
    double balance_error = 0;  ///< |imbalance| over the loop / integral of |volume * stress d strain|
};

struct SweepResponse {
    std::vector<AmplitudeResponse> amplitudes;
    std::vector<BrokenBond> broken;
    std::optional<NetworkFailure> failure;  ///< the sweep ends there; `amplitudes` are those completed before
    SolverEffort effort;
};

/// Shears, stretches or compresses to a strain. All particles and images follow each strain step affinely, then every particle is
/// brought to balance of force and moment: corrections by a Cholesky factor of the symmetric part of the tangent, brought up to
/// date with the contacts that open, close, slip or break, accelerated by Anderson's method; where that stalls Newton's method,
/// generalised minimal residuals preconditioned by the factor (Knoll and Keyes, J. Comput. Phys. 193 (2004) 357). The tangent is
/// that of the contact law by differences; the shift on the diagonal of the factor does not enter the residual. Where a bond passes
/// its strength the strain at which it does so is found, the bond breaks there, and the network comes to rest at constant strain,
/// bond after bond, the most overloaded first. The run ends where the network fails.
///
/// Throws std::invalid_argument for impossible options, an open cell, and models with losses that depend on the rate;
/// std::runtime_error where no equilibrium is found.
RampResponse shear_to(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model, const RampOptions& options,
                      const Progress& progress = {});

/// Cycles of strain = amplitude sin(phase) at each amplitude, each from strain 0 and back to it, in the order given.
/// With an ageing model the stiffness of a contact grows from amplitude to amplitude by GeneralContact::reage().
SweepResponse sweep_amplitudes(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                               const SweepOptions& options, const Progress& progress = {});

/// Secant shear moduli of the six orientations at one strain [Pa], in the order of all_orientations(). Throws std::runtime_error
/// where the network fails before.
std::vector<double> small_strain_moduli(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                                        double strain, const QuasistaticOptions& options = {}, const Progress& progress = {});

/// Strain at which the modulus has fallen to `fraction` of the first one, by linear interpolation; NaN if it has not.
double yield_strain(const std::vector<double>& strain, const std::vector<double>& modulus, double fraction);

}  // namespace coagula::mechanics
