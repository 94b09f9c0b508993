// SPDX-License-Identifier: GPL-3.0-or-later
// The words of a command line as the values of a verb's options.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <string>
#include <vector>

namespace coagula::tools {

struct CommandLine {
    stages::Call call;
    bool help_wanted = false;
    std::vector<std::string> notes = {};  ///< sentences about old names that were used
};

/// Throws InputError with a sentence that names the word and the rule.
/// @param typed what follows the verb on the command line.
CommandLine read_command_line(const stages::Verb& verb, const std::vector<std::string>& typed);

}  // namespace coagula::tools
