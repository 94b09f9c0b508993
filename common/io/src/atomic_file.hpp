// Files that appear whole or not at all.
#pragma once

#include <span>
#include <string>

namespace coagula::io {

/// Writes the bytes to a hidden temporary file beside `path`, syncs it to the disk and renames it. Throws as check_output does, and
/// std::runtime_error ("cannot write FILE: reason") when that fails; the temporary file is removed and an older `path` untouched.
void write_file(const std::string& path, std::span<const char> bytes, bool overwrite);

}  // namespace coagula::io
