// SPDX-License-Identifier: GPL-3.0-or-later
// The file from which an explicit rheometer run goes on.
#pragma once

#include <coagula/mechanics/rheometer.hpp>

#include <string>

namespace coagula::stages {

/// Writes a checkpoint by temporary file and rename.
/// @param signature text that tells runs apart: options and structure.
void write_checkpoint(const std::string& path, const std::string& signature, const mechanics::RheometerCheckpoint& checkpoint);

/// Throws InputError when the file is no checkpoint, is damaged or belongs to another run.
mechanics::RheometerCheckpoint read_checkpoint(const std::string& path, const std::string& signature);

}  // namespace coagula::stages
