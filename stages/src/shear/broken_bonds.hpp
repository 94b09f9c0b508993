// SPDX-License-Identifier: GPL-3.0-or-later
// Causes of breakage, for the methods that break bonds.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/common/general_contact.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// Number of broken bonds, number by each cause, and the cause of each.
/// @param path of the group they go into, with the slash at its end.
void append_causes(Results& results, const std::string& path, const std::vector<BreakageCause>& causes);

}  // namespace coagula::stages
