// SPDX-License-Identifier: GPL-3.0-or-later
// Data sets about the bonded network itself, which every method of `coagula shear` writes.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <optional>
#include <string>

namespace coagula::stages {

/// Rattlers, floppy modes and affine modulus by the linear solver, below `group` ("/mechanics/dem/"). Where the contacts have no
/// stiffness as found (Hertz's law without prestress) or the network is unstable, floppy modes are not counted: -1.
/// Returns the linear response as found; nothing in those two cases.
std::optional<mechanics::LinearResponse> append_network_keys(Results& results, const std::string& group, const Packing& packing,
                                                             const ContactNetwork& bonds, const ContactModel& model,
                                                             const Progress& progress);

/// Whether the network, whose linear response is given, has a modulus of this orientation. What a simulation measures where it has
/// none is rounding, or inertia.
bool has_modulus(const mechanics::LinearResponse& linear, const mechanics::ShearOrientation& orientation);

/// Where it has none in some plane: why, as a text of the results and a line of the table.
void append_reason(Findings& found, const Packing& packing, const ContactNetwork& bonds, const mechanics::LinearResponse& linear);

/// The same where no linear response is known, which is then computed.
void append_reason(Findings& found, const Packing& packing, const ContactNetwork& bonds, const Progress& progress);

/// Stiffness of a contact as found, mean over the bonds.
void append_contact_stiffness(Results& results, const std::string& group, const Packing& packing, const ContactNetwork& bonds,
                              const ContactModel& model);

}  // namespace coagula::stages
