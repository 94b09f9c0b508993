// SPDX-License-Identifier: GPL-3.0-or-later
// The text that --help prints.
#pragma once

#include "stages.hpp"

#include <string>

namespace coagula::tools {

/// Unit, choices, default and range of an option in brackets, with a blank in front; empty when there is nothing to say.
std::string remarks(const Option& option);

/// The help text of a verb: one line per option with unit, default and range.
std::string help_text(const Verb& verb);

}  // namespace coagula::tools
