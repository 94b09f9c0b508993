// SPDX-License-Identifier: GPL-3.0-or-later
// Masses that make an explicit run stable at a given time step.
#pragma once

#include <coagula/common/general_contact.hpp>
#include <coagula/mechanics/rheometer.hpp>

namespace coagula::mechanics {

/// Mass of a particle of mean radius [kg] (others in proportion to their volume) for which the time step is four fifths of the
/// stability limit of central differences, dt^2 l_k / 4 + dt l_c / 2 < 1, with Gershgorin's bounds l_k and l_c of the eigenvalues
/// of stiffness and dashpots over mass.
double scaled_mass(const Packing& packing, const ContactNetwork& bonds, const GeneralContact& law, const RheometerOptions& options,
                   double time_step);

/// Normal stiffness of a contact in the run, the stiffest one, x mean radius [N].
double force_unit(const Packing& packing, const ContactNetwork& bonds, const GeneralContact& law, const RheometerOptions& options);

}  // namespace coagula::mechanics
