// SPDX-License-Identifier: GPL-3.0-or-later
// Where results go, checked before the work begins.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <string>
#include <vector>

namespace coagula::stages {

/// Throws InputError unless a new file can be made at `path` or, with --force, replace one there, and the call neither reads that
/// file nor writes it twice. Files are told apart by what they are, whatever their names.
/// @param also_read files that the call reads and no option names.
void check_output(const Arguments& arguments, const std::string& path, const std::vector<std::string>& also_read = {});

/// Throws InputError when the call reads the file at `path`.
void check_not_read(const Arguments& arguments, const std::string& path, const std::vector<std::string>& also_read = {});

/// Throws InputError when `path` is the file `input` or one of the others that are read.
void check_not_read(const std::string& path, const std::string& input, const std::vector<std::string>& others);

/// Throws InputError unless results can be added to the file itself.
void check_updatable(const std::string& path);

/// The file that the results of a stage are added to: --output, or else the input file itself. Both are checked.
std::string checked_target(const Arguments& arguments);

}  // namespace coagula::stages
