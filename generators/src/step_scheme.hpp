// One step of Brownian motion: Euler-Maruyama, or the stabilised Chebyshev scheme SK-ROCK.
#pragma once

#include "brownian_kernels.hpp"

#include <vector>

namespace coagula::generators {

/// Weights of the stages. K_0 = X; the force of the first stage is taken at X + evaluation Q, those of the others at the stage
/// before; Q is the displacement sqrt(2 kB T mobility dt) times a standard normal vector. The last stage is the new position.
struct StepScheme {
    std::vector<StageWeights> stages;
    double evaluation = 0;
    /// The scheme is stable for |dt times eigenvalue of mobility times stiffness| up to this.
    double stability = 2;
    /// Positions to measure are those of the scheme plus this times a displacement like Q, drawn anew (the postprocessor of the
    /// scheme): a linear mode then has its Boltzmann variance to second order in the time step.
    double observation = 0;
};

/// X + dt mobility F(X) + Q.
StepScheme euler_maruyama();

/// SK-ROCK of Abdulle, Almuslimani, Vilmart, SIAM/ASA J. Uncertainty Quantification 6 (2018) 937, eq. (8), with postprocessor.
/// Unlike a Runge-Kutta-Chebyshev step with frozen noise it keeps stiff modes at their temperature. One stage without damping is
/// the scheme of Leimkuhler and Matthews (2013).
/// @param stages s >= 1. @param damping eta >= 0. The paper takes 0.05; that leaves the contacts of this work 15 % too cold, 0.005
/// hardly 2 %.
StepScheme stabilised_scheme(int stages, double damping = 0.005);

}  // namespace coagula::generators
