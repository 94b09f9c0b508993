// SPDX-License-Identifier: GPL-3.0-or-later
// Completion of the command line in bash and zsh, from the tables of options.
#pragma once

#include "stages.hpp"

#include <string>
#include <vector>

namespace coagula::tools {

/// A script for bash that defines the completion of coagula. It needs no other package.
std::string bash_completion(const std::vector<Verb>& verbs);

/// The function _coagula for the fpath of zsh.
std::string zsh_completion(const std::vector<Verb>& verbs);

}  // namespace coagula::tools
