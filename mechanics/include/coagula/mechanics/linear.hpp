// SPDX-License-Identifier: GPL-3.0-or-later
// Linear elastic response of a bonded network in a periodic cell: all six unit strains from one factorisation.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <filesystem>
#include <functional>
#include <vector>

namespace coagula::mechanics {

enum class LinearSolver {
    automatic,  ///< direct where the predicted memory fits, else iterative
    direct,     ///< supernodal sparse Cholesky
    iterative,  ///< preconditioned conjugate gradients
    external,   ///< those of another program, see LinearOptions::call
};

struct LinearOptions {
    double normal_stiffness = 100;              ///< of a particle [N/m], > 0; two in series make a contact
    double shear_stiffness = 10;                ///< of a particle [N/m], >= 0
    std::vector<ContactTangent> bond_tangents;  ///< M: stiffness of every bond instead of those two, see bond_tangents(); or empty
    LinearSolver solver = LinearSolver::automatic;
    double memory_limit = 5e8;        ///< for the factor [bytes]; decides under `automatic`
    double tolerance = 1e-10;         ///< direct solver: relative residual |f - K u| / |f| of every strain
    double modulus_tolerance = 1e-5;  ///< iterative solver: estimated relative error of the moduli
    double shift =
        1e-10;  ///< added to the diagonal of the preconditioner, in contact stiffnesses; the result does not depend on it
    std::vector<bool> held;  ///< N flags for a sample with a free surface: these particles follow the strain without rotating;
                             ///< empty for a periodic cell
    double volume = unset;   ///< with `held`: volume of the particles that are not held [m^3]
    /// Calls coagula-petsc, or a program alike, with the problem that lies in the first file; it writes the solution to the second.
    /// Not set: solved here.
    std::function<void(const std::filesystem::path&, const std::filesystem::path&)> call;
    std::filesystem::path folder;  ///< with `call`: for those files
};

/// Response to the six unit strains, Voigt order xx yy zz yz xz xy; shear components are engineering strains.
struct LinearResponse {
    Eigen::Matrix<double, 6, 6> elastic_tensor;  ///< relaxed [Pa]
    Eigen::Matrix<double, 6, 6> affine_tensor;   ///< without relaxation: all particles follow the strain, none rotates [Pa]
    std::vector<Eigen::Matrix3Xd> displacement;  ///< six times 3 x N: beyond the affine one, per unit strain [m]; 0 for rattlers
    std::vector<Eigen::Matrix3Xd> rotation;      ///< six times 3 x N: rotation per unit strain [rad]
    Eigen::Matrix<double, 6, 1> non_affinity;    ///< rms displacement beyond the affine one per unit strain, over the mean radius
    std::vector<ContactTangent> bond_tangents;   ///< M: stiffness of every bond
    double contact_normal_stiffness = unset;     ///< of a contact, mean over the bonds [N/m]
    double contact_shear_stiffness = unset;
    Index contacts = 0;  ///< all bonds
    Index rattlers = 0;  ///< particles that carry no load
    /// Modes of the load-bearing rest whose stiffness is below 1e-6 of the contact's, rigid translation apart; -1: not counted
    /// (iterative solver).
    Index floppy_modes = -1;
    LinearSolver solver_used = LinearSolver::direct;
    double predicted_memory = unset;  ///< of the factor [bytes]
    int iterations = 0;               ///< of conjugate gradients, largest over the strains
    double residual = 0;              ///< |f - K u| / |f|, recomputed from K itself, largest over the strains
    /// The error itself was half to ten times this estimate where it was compared with the direct solver.
    double modulus_error = 0;  ///< estimated relative error of the moduli from stopping early (iterative solver)

    /// Shear modulus of one orientation (strain plane a-b with a, b in 0..2) [Pa].
    double shear_modulus(int a, int b) const;
    /// Mean over the six orientations, and their spread.
    double mean_shear_modulus() const;
    double shear_modulus_deviation() const;
    /// Affine shear modulus, mean over the orientations [Pa].
    double mean_affine_modulus() const;
};

/// Stiffness of every bond for small motion from where it is found: fresh bonds of `model` that carry its prestress and nothing
/// else. Strengths, friction, ageing and losses play no part. Throws std::invalid_argument for an impossible model.
std::vector<ContactTangent> bond_tangents(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model);

/// Solves for the response of `bonds` (branch vectors as found; springs unstretched there, lever arms d r_i / (r_i + r_j)):
/// E = 1/2 sum [k_n (delta.n)^2 + k_s |delta_t|^2 + k_b |bend_t|^2 + k_t (bend.n)^2 + tension |moved_t|^2] is minimised over all
/// displacements and rotations, and the elastic tensor is the second derivative of the minimum by the strain over the volume.
/// delta is the displacement at the contact, bend the relative rotation, moved the relative displacement of the centres, t the part
/// across n. Contact law: Schenker et al. 2012, sec. 2.1; the last three terms with `bond_tangents` only.
///
/// In a periodic cell the volume is the cell's. A sample with a free surface needs `held` (its outer particles): they follow the
/// strain as a rigid frame would make them, and the stress is averaged over the others, whose volume is `volume`; that stiffens.
///
/// Throws std::invalid_argument for impossible options, a bond without normal stiffness or an open cell without `held`,
/// std::runtime_error when the solver fails, as it does where prestress makes the network unstable.
/// A network that does not carry load in some direction has modulus zero there: no error. So has one whose modulus is below 1e-8 of
/// the affine one, which is what rounding leaves.
LinearResponse solve_linear(const Packing& packing, const ContactNetwork& bonds, const LinearOptions& options = {},
                            const Progress& progress = {});

}  // namespace coagula::mechanics
