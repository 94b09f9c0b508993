// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Brownian motion: Euler-Maruyama, or a stabilised Chebyshev scheme.
#pragma once

#include "brownian_kernels.hpp"

#include <vector>

namespace coagula::generators {

/// Weights of the stages. K_0 = X; the force of the first stage is taken at X + evaluation Q, those of the others at the stage
/// before; Q and R are sqrt(2 kB T mobility dt) times independent vectors of independent numbers of variance 1, normal ones for Q;
/// R is so small that it may be uniform. The last stage is the new position.
struct StepScheme {
    std::vector<StageWeights> stages;
    double evaluation = 0;
    /// The scheme is stable for |dt times eigenvalue of mobility times stiffness| up to this.
    double stability = 2;
    /// Positions to measure are those of the scheme plus this times a displacement like Q, drawn anew (the postprocessor of the
    /// scheme).
    double observation = 0;

    bool two_noises() const { return stages.size() > 1; }
};

/// X + dt mobility F(X) + Q.
StepScheme euler_maruyama();

/// SK-ROCK of Abdulle, Almuslimani, Vilmart, SIAM/ASA J. Uncertainty Quantification 6 (2018) 937, eq. (8), with its postprocessor
/// but with another noise: in the paper's, damping makes modes too hot or too cold, by half and more around dt times eigenvalue =
/// 5, 20, 44 ..., where the noise vanishes. A second noise fills these up, so that every linear mode has its Boltzmann variance
/// exactly, for any damping up to the stability bound. Without damping the scheme is the paper's; one stage without damping is that
/// of Leimkuhler and Matthews (2013).
/// @param stages s >= 1. @param damping eta >= 0. A stiff mode forgets in 1/eta steps or less; stability is (2 - 4 eta/3) s^2.
StepScheme stabilised_scheme(int stages, double damping = 0.05);

}  // namespace coagula::generators
