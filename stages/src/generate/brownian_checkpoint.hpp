// SPDX-License-Identifier: GPL-3.0-or-later
// The file from which a Brownian run goes on.
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>

#include <string>

namespace coagula::stages {

/// Writes a checkpoint by temporary file and rename.
/// @param signature text that tells runs apart: options and start.
void write_checkpoint(const std::string& path, const std::string& signature, const generators::BrownianCheckpoint& checkpoint);

/// Throws InputError when the file is no checkpoint, is damaged or belongs to another run.
generators::BrownianCheckpoint read_brownian_checkpoint(const std::string& path, const std::string& signature);

}  // namespace coagula::stages
