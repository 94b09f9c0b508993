// Where results go, checked before the work begins.
#pragma once

#include "arguments.hpp"

#include <string>

namespace coagula::tools {

/// Throws InputError unless a new file can be made at `path`: its folder exists and can be written, and nothing is there yet
/// or `force` is set.
void check_output(const std::string& path, bool force);

/// Throws InputError unless results can be added to the file itself.
void check_updatable(const std::string& path);

/// The file that the results of a stage are added to: --output, or else the input file itself. Both are checked.
std::string checked_target(const Arguments& arguments);

}  // namespace coagula::tools
