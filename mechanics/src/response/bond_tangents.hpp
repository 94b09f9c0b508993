// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of the bonds of a network as found, and its derivatives by the parameters of the model.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>

#include <span>
#include <vector>

namespace coagula::mechanics {

/// Throws std::invalid_argument unless there is a possible stiffness for every bond.
void check_tangents(const ContactNetwork& bonds, const std::vector<ContactTangent>& tangents);

/// Mean normal and shear stiffness, exact where all bonds are alike; zero without bonds.
ContactTangent mean_tangent(std::span<const ContactTangent> tangents);

/// Whether some bond resists bending or twisting.
bool resist_moments(const std::vector<ContactTangent>& tangents);

/// Whether some bond has a negative stiffness.
bool may_be_unstable(const std::vector<ContactTangent>& tangents);

/// Derivative of bond_tangents() by a parameter that the model has, of the role `spring`: exact where it is a factor, else by
/// differences of the second order (relative error about 1e-8).
std::vector<ContactTangent> tangent_derivatives(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                                                const ContactParameter& parameter);

}  // namespace coagula::mechanics
