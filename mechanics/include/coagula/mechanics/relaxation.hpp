// SPDX-License-Identifier: GPL-3.0-or-later
// Relaxation of a bonded packing before it is sheared.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::mechanics {

enum class RelaxationScheme {
    minimise,      ///< FIRE: fastest
    stopped_steps  ///< explicit steps after each of which all velocities are set to zero (Schenker et al. 2012)
};

struct RelaxationOptions {
    double normal_stiffness = 100;  ///< of a particle [N/m], > 0; two in series make a contact
    double shear_stiffness = 10;    ///< of a particle [N/m], >= 0; shear springs are unstretched at the start
    RelaxationScheme scheme = RelaxationScheme::minimise;
    double tolerance = 1e-7;  ///< rms force on a particle over (normal contact stiffness x mean radius) that counts as rest
};

/// The packing at rest.
struct RelaxedNetwork {
    Packing packing;
    ContactNetwork bonds;           ///< the same bonds with their branches now
    Eigen::Matrix3Xd displacement;  ///< 3 x N: how far each particle moved [m]
    double rms_force = unset;       ///< left, over (normal contact stiffness x mean radius)
    Index iterations = 0;
};

/// Lets the bonds, springs both ways with rest length r_i + r_j, pull the particles to mechanical equilibrium; unbonded particles
/// repel where they overlap. Throws std::invalid_argument for impossible options, std::runtime_error if it does not come to rest.
RelaxedNetwork relax(const Packing& packing, const ContactNetwork& bonds, const RelaxationOptions& options = {},
                     const Progress& progress = {});

}  // namespace coagula::mechanics
