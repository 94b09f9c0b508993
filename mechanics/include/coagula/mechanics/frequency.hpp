// SPDX-License-Identifier: GPL-3.0-or-later
// Frequency response of a bonded network with losses in a periodic cell: complex moduli and their derivatives by every contact
// parameter, for all six strains.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <complex>
#include <span>
#include <vector>

namespace coagula::mechanics {

using ComplexTensor = Eigen::Matrix<std::complex<double>, 6, 6>;  ///< Voigt order xx yy zz yz xz xy, engineering shear strains

struct FrequencyOptions {
    double tolerance = 1e-10;  ///< relative residual |f - K* u| / |f| of every strain
    double shift = 1e-10;  ///< smallest stiffness that the preconditioner gives to any motion, in contact stiffnesses; the result
                           ///< does not depend on it
};

/// Response at one frequency.
struct FrequencyPoint {
    double frequency = unset;                 ///< [Hz]
    ContactStiffness contact_stiffness;       ///< k* of a contact, mean over the bonds [N/m]
    ComplexTensor modulus;                    ///< G' + i G'' for all strains [Pa]; symmetric
    std::vector<ComplexTensor> derivative;    ///< of `modulus` by each of FrequencyResponse::parameters [Pa per its unit]
    Eigen::Matrix<double, 6, 1> dissipation;  ///< energy lost in a cycle, summed over bonds and particles, over the volume and the
                                              ///< squared amplitude of the strain [Pa]: pi G''
    int iterations = 0;                       ///< of the solver, largest over the strains
    double residual = 0;                      ///< |f - K* u| / |f|, recomputed from K* itself, largest over the strains

    /// Complex shear modulus of one orientation (plane a-b, a and b different axes 0..2) [Pa].
    std::complex<double> shear_modulus(int a, int b) const;
    /// Mean over the orientations, whose arg() is the phase [rad].
    std::complex<double> mean_shear_modulus() const;
    /// Mean of a derivative over the orientations.
    std::complex<double> mean_derivative(std::size_t parameter) const;
};

struct FrequencyResponse {
    std::vector<FrequencyPoint> points;        ///< in the order of the frequencies asked for
    std::vector<ContactParameter> parameters;  ///< those that the model has and that act at vanishing strain
    Index contacts = 0;                        ///< all bonds
    Index rattlers = 0;                        ///< particles that carry no load; with drag: that have no bond
};

/// Solves K*(w) u = f*(w) at each frequency for small harmonic strains e^{i w t} without inertia.
///
/// A bond has the springs of bond_tangents() with the losses of `model` beside them and the kinematics of solve_linear. The solvent
/// moves affinely and drags on every particle that moves or turns otherwise, with -i w 6 pi eta r u and -i w 8 pi eta r^3 theta;
/// what the solvent itself adds to the stress (i w eta of a pure fluid) is not in the modulus. With lubrication, pairs of
/// particles, bonded or not, whose gap h is below the cutoff squeeze a film: a dashpot 6 pi eta R^2 / max(h, lubrication_gap) along
/// the line of centres, R = r_i r_j / (r_i + r_j); the derivative by the cutoff is zero, because pairs come and go one by one. G*
/// is the stationary value of [sum over bonds e.k*e + i w (drag) u.u] / V, e the relative displacement at the contact, which is
/// second-order accurate in the error of the solution, and dG* / dp = [sum e.(dk*/dp) e + ...] / V follows from the same solution,
/// because the value is stationary.
///
/// K* is complex symmetric. Motions without any stiffness (none with drag) are found and treated as in solve_linear.
///
/// @param frequencies [Hz], > 0.
/// Throws std::invalid_argument for an impossible model, frequency or option and for an open cell; std::runtime_error when a
/// frequency cannot be solved to the tolerance. A network that does not carry load has modulus zero: no error.
FrequencyResponse solve_frequency_sweep(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                                        std::span<const double> frequencies, const FrequencyOptions& options = {},
                                        const Progress& progress = {});

}  // namespace coagula::mechanics
