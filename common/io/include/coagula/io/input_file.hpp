// SPDX-License-Identifier: GPL-3.0-or-later
// Files that somebody else wrote, read as a whole.
#pragma once

#include <coagula/common/checks.hpp>

#include <string>

namespace coagula::io {

/// Throws InputError, naming the file, unless it is there and is a regular file: a pipe would be waited for, a device never ends.
void check_input(const std::string& path);

/// All bytes of a regular file. Throws InputError when it cannot be read.
std::string read_file(const std::string& path);

/// The text of a TOML file, to be parsed. Throws InputError when it cannot be read, is larger than a megabyte, or nests tables and
/// arrays so deeply (64 levels) that a parser that descends into them could run out of its stack.
std::string read_toml_text(const std::string& path);

}  // namespace coagula::io
