// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a stage as its entry in the provenance of a file has them.
#pragma once

#include <coagula/stages/findings.hpp>

#include <string>

namespace coagula::stages {

/// A text that is no JSON stays a text. Throws InputError that names the file when the text is JSON nested deeper than 16 levels,
/// which no stage writes.
Json recorded_options(const std::string& path, const std::string& text);

}  // namespace coagula::stages
