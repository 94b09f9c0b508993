// SPDX-License-Identifier: GPL-3.0-or-later
// An experiment file written from the exports of instruments.
#pragma once

#include <coagula/experiment/recognised_table.hpp>

#include <string>
#include <vector>

namespace coagula::experiment {

/// The commented experiment file. Paths are written relative to `folder`.
std::string new_experiment(const std::vector<RecognisedFile>& files, const std::string& folder);

}  // namespace coagula::experiment
