// SPDX-License-Identifier: GPL-3.0-or-later
// Relaxation of a bonded packing to mechanical equilibrium.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

namespace coagula::dem {

enum class RelaxMethod {
    fire,          ///< minimisation; fastest
    damped,        ///< explicit steps with local damping
    stopped_steps  ///< explicit steps after each of which all velocities are set to zero (Schenker et al. 2012, section 2.2)
};

struct RelaxOptions {
    double normal_stiffness = 50;  ///< of a contact [N/m], > 0
    double shear_stiffness = 0;    ///< of a bonded contact [N/m]; 0: central forces, nothing rotates
    RelaxMethod method = RelaxMethod::fire;
    double damping = 0.3;        ///< alpha, for RelaxMethod::damped
    double fire_below = 0;       ///< rms force, as for the tolerance, at which FIRE takes over from damped steps; 0: never
    double tolerance = 1e-7;     ///< rms force on a particle over (normal stiffness x mean radius)
    bool bond_on_touch = false;  ///< particles that come to overlap are bonded, too
    Index max_iterations = 1000000;
};

struct Relaxation {
    Packing packing;           ///< at rest
    ContactNetwork bonds;      ///< with their branches now; includes bonds made on touch
    double rms_force = unset;  ///< on a particle, over (normal stiffness x mean radius)
    Index iterations = 0;
    bool converged = false;  ///< whether rms_force fell below the tolerance
};

/// Relaxes `packing`. Bonds are springs both ways with rest length r_i + r_j, with a shear spring if a stiffness is given (shear
/// displacements start at zero); unbonded particles repel where they overlap. Masses are equal and fictitious: only the state at
/// rest has a meaning.
Relaxation relax(const Packing& packing, const ContactNetwork& bonds, const RelaxOptions& options = {},
                 const Progress& progress = {});

}  // namespace coagula::dem
