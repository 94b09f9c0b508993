// SPDX-License-Identifier: GPL-3.0-or-later
// Preconditioned conjugate gradients for six loads, each of which ends by itself.
#pragma once

#include "stiffness.hpp"

#include <coagula/common/progress.hpp>

#include <functional>

namespace coagula::mechanics {

/// When to stop. A column ends as soon as it meets either rule: iterating on would only feed rounding errors into the modes
/// without stiffness, which the preconditioner amplifies.
struct StopRule {
    double residual =
        1e-10;          ///< |f - K u| / |f|; of a load that hardly any force is left of, over 1e-5 of the root of the affine energy
    double energy = 0;  ///< estimated error of the energy, relative to the energy that is left; 0: not used
    int most_iterations = 200;
};

struct Solution {
    Loads motion;
    int iterations = 0;       ///< largest over the columns
    double residual = 0;      ///< recomputed from K and the motion; largest over the columns
    double energy_error = 0;  ///< the estimate, largest over the columns
    bool converged = false;
};

/// Solves K x = f for each load by itself.
/// The estimate of the energy error is that of Hestenes and Stiefel (1952): what the last `delay` iterations gained.
/// @param affine_energy f-independent part of each column's energy: what is left is affine_energy - f x.
Solution conjugate_gradients(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
                             const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule,
                             const Progress& progress);

/// Solves K x = f for all six loads in the space that they have reached together (O'Leary, Linear Algebra Appl. 29, 293, 1980). It
/// needs fewer products with K than conjugate_gradients(). Where K has modes of hardly any stiffness it does not come as close to
/// the solution.
Solution block_conjugate_gradients(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
                                   const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule,
                                   const Progress& progress);

}  // namespace coagula::mechanics
