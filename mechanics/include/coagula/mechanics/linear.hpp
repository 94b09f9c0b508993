// Linear elastic response of a bonded network in a periodic cell: all six unit strains from one factorisation.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

enum class LinearSolver {
    automatic,  ///< direct where the predicted memory fits, else iterative
    direct,     ///< supernodal sparse Cholesky
    iterative,  ///< preconditioned conjugate gradients
};

struct LinearOptions {
    double normal_stiffness = 100;  ///< of a particle [N/m]; two in series make a contact
    double shear_stiffness = 10;    ///< of a particle [N/m]
    LinearSolver solver = LinearSolver::automatic;
    double memory_limit = 4.0e9;  ///< for the factor [bytes]; decides under `automatic`
    double tolerance = 1e-10;     ///< relative residual |f - K u| / |f| to which every strain is solved
    double shift = 1e-10;  ///< added to the diagonal of the preconditioner, as a fraction of the contact stiffness; the result does
                           ///< not depend on it
};

/// Response to the six unit strains, Voigt order xx yy zz yz xz xy; shear components are engineering strains.
struct LinearResponse {
    Eigen::Matrix<double, 6, 6> elastic_tensor;  ///< relaxed [Pa]
    Eigen::Matrix<double, 6, 6> affine_tensor;   ///< without relaxation: all particles follow the strain, none rotates [Pa]
    std::vector<Eigen::Matrix3Xd>
        displacement;  ///< six times 3 x N: displacement beyond the affine one per unit strain [m]; zero for rattlers
    std::vector<Eigen::Matrix3Xd> rotation;    ///< six times 3 x N: rotation per unit strain [rad]
    Eigen::Matrix<double, 6, 1> non_affinity;  ///< rms displacement beyond the affine one per unit strain, over the mean radius
    double contact_normal_stiffness = unset;   ///< of a contact [N/m]
    double contact_shear_stiffness = unset;
    Index contacts = 0;       ///< all bonds
    Index rattlers = 0;       ///< particles that carry no load
    Index floppy_modes = -1;  ///< zero-energy modes of the load-bearing rest, rigid translation apart; -1 where not counted
    LinearSolver solver_used = LinearSolver::direct;
    double predicted_memory = unset;  ///< of the factor [bytes]
    int iterations = 0;               ///< of conjugate gradients, largest over the strains
    double residual = unset;          ///< |f - K u| / |f|, largest over the strains

    /// Shear modulus of one orientation (strain plane a-b with a, b in 0..2) [Pa].
    double shear_modulus(int a, int b) const;
    /// Mean over the six orientations, and their spread.
    double mean_shear_modulus() const;
    double shear_modulus_deviation() const;
    /// Affine shear modulus, mean over the orientations [Pa].
    double mean_affine_modulus() const;
};

/// Solves for the response of `bonds` (branch vectors as found; springs unstretched there, lever arms d r_i / (r_i + r_j)).
/// G = 2 E_min / (V gamma^2), see Schenker et al. 2012 for the contact law.
LinearResponse solve_linear(const Packing& packing, const ContactNetwork& bonds, const LinearOptions& options = {},
                            const Progress& progress = {});

}  // namespace coagula::mechanics
